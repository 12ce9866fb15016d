open Dolphin_semantics
open Core

type t = { expressions : (site, expression) Hashtbl.t; lambdas : (int, lambda) Hashtbl.t }

let rec add_lambda nodes (lambda : lambda) =
  if not (Hashtbl.mem nodes.lambdas lambda.id) then begin
    Hashtbl.replace nodes.lambdas lambda.id lambda;
    add nodes lambda.code
  end

and add nodes (e : expression) =
  Hashtbl.replace nodes.expressions e.site e;
  match e.node with
  | Constant (Closure { lambda; _ }) | Make_closure (lambda, _) -> add_lambda nodes lambda
  | _ -> List.iter (add nodes) (Code_walk.parts e)

let of_program (program : program) =
  let nodes = { expressions = Hashtbl.create 256; lambdas = Hashtbl.create 32 } in
  List.iter (add_lambda nodes) (Code_walk.pieces program);
  nodes

let expression nodes site = Hashtbl.find_opt nodes.expressions site
let lambda nodes id = Hashtbl.find_opt nodes.lambdas id
