open Core

type key = { code : int; parameter : int }
type content = {
  lambdas : lambda list;
  keys : key list;
  computed : (lambda * expression) list;  (* expressions of numbers and texts, each with the code that owns it *)
  unknown : bool;
}

let nothing = { lambdas = []; keys = []; computed = []; unknown = false }
let unknown = { nothing with unknown = true }

let both a b =
  let more xs ys ~mem = List.fold_left (fun xs y -> if mem y xs then xs else y :: xs) xs ys in
  let mem_computed (_, e) = List.exists (fun (_, e') -> e == e') in
  { lambdas = more a.lambdas b.lambdas ~mem:List.memq; keys = more a.keys b.keys ~mem:List.mem;
    computed = more a.computed b.computed ~mem:mem_computed;
    unknown = a.unknown || b.unknown }

let size c = List.length c.lambdas + List.length c.keys + List.length c.computed + Bool.to_int c.unknown

type t = { slots : (int * int, content) Hashtbl.t; mutable grown : bool }

let slot t (lambda : lambda) i = Option.value (Hashtbl.find_opt t.slots (lambda.id, i)) ~default:nothing

let add t (lambda : lambda) i c =
  let before = slot t lambda i in
  let after = both before c in
  if size after > size before then begin
    t.grown <- true;
    Hashtbl.replace t.slots (lambda.id, i) after
  end

let rec computes e =
  match e.node with
  | Constant (Integer _ | Number _ | String _) | Global _ | Local _ -> true
  | Apply ((Unary Negate | Binary (Add | Subtract | Multiply | Divide | Remainder | Power) | Property _), es)
  | Apply (Builtin (Math _), es) -> List.for_all computes es
  | Apply (Builtin Time_of_day, [ e ]) -> computes e
  | _ -> false

let rec content t lambda e =
  match e.node with
  | Local i -> slot t lambda i
  | Make_closure (made, _) | Constant (Closure { lambda = made; _ }) -> { nothing with lambdas = [ made ] }
  | Set_local (_, e) -> content t lambda e
  | If (_, a, b) -> both (content t lambda a) (content t lambda b)
  | Block es -> List.fold_left (fun _ e -> content t lambda e) unknown es
  | _ when computes e -> { nothing with computed = [ (lambda, e) ] }
  | _ -> unknown

let give t (lambda : lambda) given = for i = 0 to lambda.parameters - 1 do add t lambda i (given i) done

(* Code that any other may call, with any arguments. *)
let escape t c = List.iter (fun lambda -> give t lambda (fun _ -> unknown)) c.lambdas

(* [passed]: the value of [e] goes to where it is not followed. *)
let rec follow t lambda ~passed e =
  let part = follow t lambda in
  let parts ~passed = List.iter (part ~passed) in
  if passed then escape t (content t lambda e);
  match e.node with
  | Make_closure (made, captured) ->
    List.iter2 (fun i outer -> add t made i (slot t lambda outer)) (Array.to_list made.captures) captured
  | Set_local (i, e) ->
    part ~passed:false e;
    add t lambda i (content t lambda e)
  | If _ | Block _ | While _ -> parts ~passed:false (Code_walk.parts e)
  | For (i, range, body) ->
    part ~passed:true range;
    add t lambda i unknown;
    part ~passed:false body
  | Apply (Builtin Make_fresh, [ code ]) ->
    part ~passed:false code;
    let keys (made : lambda) = give t made (fun i -> { nothing with keys = [ { code = made.id; parameter = i } ] }) in
    List.iter keys (content t lambda code).lambdas
  | Apply (Call names, callee :: arguments) when List.for_all Option.is_none names ->
    let code = content t lambda callee in
    parts ~passed:false (callee :: arguments);
    let given = List.map (content t lambda) arguments in
    let fit, others = List.partition (fun (made : lambda) -> made.parameters = List.length given) code.lambdas in
    List.iter (fun made -> give t made (List.nth given)) fit;
    escape t { nothing with lambdas = others };
    if code.unknown || code.computed <> [] || others <> [] then List.iter (escape t) given
  | _ -> parts ~passed:true (Code_walk.parts e)

let of_program program =
  let t = { slots = Hashtbl.create 64; grown = true } in
  let all = Hashtbl.create 64 in
  Code_walk.iter_within (fun lambda _ -> Hashtbl.replace all lambda.id lambda) (Code_walk.pieces program);
  Option.iter (fun lambda -> escape t { nothing with lambdas = [ lambda ] }) program.on_interrupt;
  while t.grown do
    t.grown <- false;
    Hashtbl.iter (fun _ lambda -> follow t lambda ~passed:true lambda.code) all
  done;
  t

let callees t lambda e =
  match content t lambda e with { unknown = false; keys = []; computed = []; lambdas } -> Some lambdas | _ -> None

let key t lambda e =
  match content t lambda e with { unknown = false; keys = [ key ]; computed = []; lambdas = [] } -> Some key | _ -> None

let values t lambda i =
  match slot t lambda i with
  | { unknown = false; keys = []; lambdas = []; computed = _ :: _ as computed } -> Some computed
  | _ -> None
