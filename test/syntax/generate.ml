(* Random programs: every syntax tree that reading a text can give. *)

open Dolphin_syntax
open Ast
open QCheck2.Gen

let bare it = { it; at = Location.none }

let names =
  [ "a"; "b"; "v1"; "task"; "pick"; "imcPlan"; "pos"; "allOf"; "type"; "execute"; "count"; "é"; "x_1"; "choose";
    "parameter" ]
let variable_name = oneofl names
let key_name = oneofl ([ "run"; "if"; "else"; "in"; "_"; "true"; "a b"; "it's"; ""; "when"; "ensure"; "using" ] @ names)
let setting_name = oneofl ([ "run"; "if"; "else"; "then"; "in"; "onError"; "ensure"; "using" ] @ names)
let member_name = oneofl ([ "run"; "if"; "km"; "then"; "true"; "e3"; "size"; "until"; "during"; "ensure"; "using" ] @ names)

let text =
  oneof
    [ oneofl [ ""; "x"; "it's"; "\\"; "$x"; "${"; "\""; "\n\t\r\000\127"; "\xC3\xA9\xF0\x9F\x90\xAC"; "'''"; "a.b";
               ".x" ];
      string_size ~gen:(char_range ' ' '~') (int_bound 8) ]

let binary =
  oneofl
    [ Divide; Multiply; Remainder; Power; Add; Subtract; Sequence; Append; Less; Less_equal; Greater; Greater_equal;
      Equal; Not_equal; Member_of; Intersect; Around; Parallel; And; Or ]

let integer = oneof [ int_bound 20; oneofl [ max_int; 1_000_000 ] ]
let number = oneof [ map Float.abs (float_range 0. 1e6); oneofl [ 0.1; 1e300; 5e-324; 3.; 1e22; 41.185 ] ]

let atom =
  oneof
    [ oneofl [ Null; Boolean true; Boolean false; Wildcard ]; map (fun n -> Integer n) integer;
      map (fun x -> Number x) number; map (fun s -> String s) text; map (fun x -> Variable x) variable_name ]

let some gen = list_size (int_bound 3) gen
let located gen = map bare gen

(* Literals are neither empty nor neighbours: so they are read. *)
let rec template = function
  | Literal "" :: rest -> template rest
  | Literal a :: Literal b :: rest -> template (Literal (a ^ b) :: rest)
  | part :: rest -> part :: template rest
  | [] -> []

let rec expression fuel = map bare (node fuel)

and node fuel =
  if fuel <= 0 then atom
  else
    let e = expression (fuel / 2) in
    let c = closure (fuel / 2) in
    let target =
      oneof
        [ map (fun x -> bare (Variable x)) variable_name; map (fun (a, b) -> bare (Index (a, b))) (pair e e);
          map (fun (subject, name) -> bare (Member { subject; name; safe = false })) (pair e (located member_name)) ] in
    frequency
      [ 2, atom;
        1, map2 (fun parts last -> Template (template (parts @ [ Hole last ])))
          (some (oneof [ map (fun s -> Literal s) text; map (fun e -> Hole e) e ])) e;
        1, map (fun es -> List es) (some e);
        1, map (fun es -> Map es)
          (some (pair (located (oneof [ map (fun k -> Name k) key_name; map (fun e -> Computed e) e ])) e));
        1, map3 (fun first last inclusive -> Range { first; last; inclusive }) e e bool;
        2, map (fun c -> Closure c) c;
        2, map2 (fun o e -> Unary (o, e)) (oneofl [ Negate; Not ]) e;
        6, map3 (fun o a b -> Binary (o, a, b)) binary e e;
        1, map3 (fun a b c -> Conditional (a, b, c)) e e e;
        1, map2 (fun a b -> Elvis (a, b)) e e;
        1, map3 (fun target by prefix -> Increment { target; by; prefix }) target (oneofl [ 1; -1 ]) bool;
        4, map2 (fun callee arguments -> Call { callee; arguments }) e (some (argument (fuel / 2)));
        2, map2 (fun x arguments -> Call { callee = bare (Variable x); arguments }) variable_name
          (some (argument (fuel / 2)));
        2, map3 (fun subject name safe -> Member { subject; name; safe }) e (located member_name) bool;
        2, map2 (fun e i -> Index (e, i)) e e;
        1, map2 (fun b body -> Builder (b, body)) (oneofl [ Pick; Imc_plan; Pos; All_of; One_of ]) (program (fuel / 2));
        1, map2 (fun settings otherwise -> Pick_else (settings, otherwise)) (program (fuel / 2)) (program (fuel / 2));
        1, map2 (fun c t -> When (c, t)) c e;
        1, map2 (fun c t -> Wait_for (c, t)) c e;
        1, map3 (fun on_cut c t -> Until (on_cut, c, t)) (oneofl [ Completes; Fails ]) c e;
        1, map3 (fun on_cut d t -> During (on_cut, d, t)) (oneofl [ Completes; Fails ]) e e;
        1, map2 (fun settings c -> Recruit (settings, c)) (program (fuel / 2)) c;
        1, map2 (fun t c -> Watch (t, c)) e c;
        1, map2 (fun t c -> Ensure (t, c)) e c;
        1, map3 (fun rounds body until -> Repeat { rounds; body; until }) (opt e) e (opt c) ]

and argument fuel =
  oneof
    [ map (fun e -> Positional e) (expression fuel);
      map2 (fun k e -> Named (k, e)) (located key_name) (expression fuel);
      map2 (fun k e -> Keyed (k, e)) (expression (fuel / 2)) (expression fuel) ]

and closure fuel =
  map2 (fun parameters body -> { parameters; body })
    (opt (some (located variable_name))) (program fuel)

and statement fuel = map bare (statement_node fuel)

and statement_node fuel =
  let e = expression (fuel / 2) and body = program (fuel / 2) in
  let x = located variable_name in
  let simple =
    [ 5, map (fun e -> Expression e) e; 1, map2 (fun x e -> Define (x, e)) x (opt e);
      1, map3 (fun name value description -> Parameter { name; value; description }) x e (opt (located text));
      1, map (fun e -> Return e) (opt e); 1, oneofl [ Break; Continue ];
      1, map2 (fun x e -> Setting (x, e)) (located setting_name) e;
      2, map3 (fun x operator value -> Assign { target = bare (Variable x); operator; value }) variable_name
        (opt (oneofl [ Add; Subtract; Multiply; Divide ])) e;
      1, map3 (fun a b value -> Assign { target = bare (Index (a, b)); operator = None; value }) e e e ] in
  let compound =
    [ 1, map3 (fun name parameters body -> Function { name; parameters; body }) x (some x) body;
      1, map3 (fun c yes no -> If (c, yes, no)) e body body; 1, map2 (fun c body -> While (c, body)) e body;
      1, map3 (fun x e body -> For (x, e, body)) x e body; 1, map (fun body -> Block body) body ] in
  frequency (if fuel <= 0 then simple else simple @ compound)

and program fuel = if fuel <= 0 then return [] else some (statement (fuel - 1))

let program = sized_size (int_bound 40) program
