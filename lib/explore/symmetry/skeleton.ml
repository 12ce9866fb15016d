open Dolphin_semantics
open Core
module Pairs = Footprint.Pairs

module Names = Dolphin_checker.Interner.Make (struct
    type t = string

    let equal = String.equal
    let hash = Hashtbl.hash
  end)

module Pair_numbers = Dolphin_checker.Interner.Make (struct
    type t = string * value

    let equal (k, x) (k', x') = String.equal k k' && Value.compare x x' = 0
    let hash (k, x) = (Hashtbl.hash k + (65599 * Value.hash x)) land max_int
  end)

module Closures = Hashtbl.Make (struct
    type t = bool * closure

    let equal (handler, c) (handler', c') = handler = handler' && Value.compare_closure c c' = 0
    let hash (handler, c) = (2 * Value.hash_closure c) + Bool.to_int handler
  end)

type t = { number : int; pairs : int array; fixed : Pairs.t; unclear : bool }

type context = { code : Footprint.code; texts : Names.t; numbers : Pair_numbers.t; known : t Closures.t }

let context numbering program =
  {
    code = Footprint.code program;
    texts = Names.create numbering;
    numbers = Pair_numbers.create numbering;
    known = Closures.create 64;
  }

let pair c k x = Pair_numbers.number c.numbers (k, Value.normal x)
let key_of c i = fst (Pair_numbers.value c.numbers i)
let value_of c i = snd (Pair_numbers.value c.numbers i)

(* {1 Transparent code} *)

exception Opaque

(* A text made of longer ones could be too long, which is a fault. *)
let longest_text = 1_000

let may_be_named x = Footprint.is_small x && Value.is_alone x

let is_scalar = function
  | String s -> String.length s <= longest_text
  | Null | Boolean _ | Integer _ | Number _ | Symbol _ | Vehicles _ -> true
  | Wildcard | List _ | Map _ | Range _ | Position _ | Area _ | Task _ | Closure _ | Host _ | Settings _ | Reading _
  | Unknown _ ->
    false

(* A skeleton being written. *)
type writing = {
  context : context;
  captured : (int * value) list;
  handler : bool;
  text : Buffer.t;
  named : int list ref;  (* latest first *)
  touched : Pairs.t ref;
  reads_error : bool ref;
}

let print w format = Printf.bprintf w.text format

(* Without sharing, plain data is equal if and only if its bytes are. *)
let plain w x = print w "%S" (Marshal.to_string x [ Marshal.No_sharing ])

let known w e =
  match e.node with
  | Constant x -> Some x
  | Local slot -> List.assoc_opt slot w.captured
  | _ -> None

let constant w x =
  match x with
  | Wildcard -> print w "_"
  | Range (a, b) -> print w "%d..%d" a b
  | x when is_scalar x -> plain w x
  | _ -> raise Opaque

let local w slot =
  if w.handler && slot < 3 then w.reads_error := true;
  print w "L%d" slot

let rec expression w e =
  match known w e, e.node with
  | Some x, _ -> constant w x
  | None, Local slot -> local w slot
  | None, Global i -> print w "G%d" i
  | None, Set_local (i, e) -> print w "l%d" i; all w [ e ]
  | None, Set_global (i, e) -> print w "g%d" i; all w [ e ]
  | None, If (a, b, c) -> print w "if"; all w [ a; b; c ]
  | None, Block es -> print w "block"; all w es
  | None, While (a, b) -> print w "while"; all w [ a; b ]
  | None, For (i, a, b) -> print w "for%d" i; all w [ a; b ]
  | None, Return e -> print w "return"; all w [ e ]
  | None, Break -> print w "break"
  | None, Continue -> print w "continue"
  | None, Apply (operation, arguments) -> applied w operation arguments
  | None, Make_closure _ -> raise Opaque
  | None, Constant _ -> raise Opaque

and all w es =
  print w "(";
  List.iter (fun e -> expression w e; print w ";") es;
  print w ")"

and applied w operation arguments =
  match operation, arguments with
  | Builtin (Post (_ :: _ as keys) | Consume keys | Poll (_ :: _ as keys)), _ ->
    let written = function Some k -> k | None -> raise Opaque in
    plain w operation;
    List.iter2 (named w) (List.map written keys) arguments
  | Builtin (Message | Halt | Assert), [ e ] ->
    plain w operation;
    text w e
  | Builtin (Poll [] | Halt | Assert | Ignore | Propagate | Retry | Math _), _
  | (Unary _ | Binary _ | Make_list | Make_range _ | Concatenate | Element), _ ->
    plain w operation;
    all w arguments
  | Call [], [ { node = Make_closure (lambda, slots); _ } ] when lambda.parameters = 0 || lambda.implicit ->
    called w lambda slots
  | ( ( Make_map _ | Replace_element | Replace_member _ | Property _ | Call _ | Method _ | Builtin _ | Add_setting _
      | Build _ | Pick_if_any | Make_branch | Make_recruit ),
      _ ) -> raise Opaque

(* Code that is called where it is written, as that of assertions. *)
and called w lambda slots =
  let outer = List.combine (Array.to_list lambda.captures) slots in
  let capture (inner, slot) =
    match List.assoc_opt slot w.captured with
    | Some x -> Some (inner, x)
    | None ->
      print w "%d=" inner;
      local w slot;
      None
  in
  let captured = List.filter_map capture outer in
  print w "call{";
  expression { w with captured; handler = false } lambda.code;
  print w "}"

(* The value of a pair. *)
and named w k e =
  match known w e with
  | Some Wildcard -> print w "_"
  | Some x when not (may_be_named x) -> raise Opaque
  | Some x ->
    print w "#";
    w.named := pair w.context k x :: !(w.named)
  | None ->
    w.touched := Pairs.add (k, None) !(w.touched);
    expression w e

(* A text for people: no step depends on it, but it must not be a fault. *)
and text w e =
  match known w e, e.node with
  | Some x, _ when is_scalar x -> print w "T%s" (Value.kind x)
  | None, Local slot -> print w "L%d" slot
  | None, Apply (((Concatenate | Binary Add) as operation), es) ->
    plain w operation;
    print w "(";
    List.iter (fun e -> text w e; print w ";") es;
    print w ")"
  | _, _ -> expression w e

let transparent context handler (c : closure) =
  let captured = List.mapi (fun i slot -> (slot, c.captured.(i))) (Array.to_list c.lambda.captures) in
  let w =
    { context; captured; handler; text = Buffer.create 64; named = ref []; touched = ref Pairs.empty;
      reads_error = ref false }
  in
  print w "%d:" c.lambda.parameters;
  expression w c.lambda.code;
  {
    number = Names.number context.texts (Buffer.contents w.text);
    pairs = Array.of_list (List.rev !(w.named));
    fixed = !(w.touched);
    unclear = !(w.reads_error);
  }

(* {1 Any code} *)

(* A skeleton that no other code has. *)
let opaque context handler c =
  let f = Footprint.of_code context.code c in
  let name = Printf.sprintf "own %d" (Closures.length context.known) in
  {
    number = Names.number context.texts name;
    pairs = [||];
    fixed = List.fold_left Pairs.union f.posts [ f.takes; f.needs; f.tests ];
    unclear = handler || f.anything;
  }

let of_code context ~handler c =
  match Closures.find_opt context.known (handler, c) with
  | Some skeleton -> skeleton
  | None ->
    let skeleton = try transparent context handler c with Opaque -> opaque context handler c in
    Closures.add context.known (handler, c) skeleton;
    skeleton
