module Ast = Dolphin_syntax.Ast
open Core

let shell program at label parameters =
  {
    id = Scope.fresh_lambda_id program;
    label;
    parameters;
    implicit = false;
    captures = [||];
    slots = 0;
    code = { node = Constant Null; site = Scope.site program at };
    lambda_site = Scope.site program at;
  }

let fill (env : Checks.env) (lambda : lambda) purpose parameters at body =
  let code = Scope.code env.program purpose None in
  Checks.check_parameters env.program parameters;
  List.iter (fun (x : string Ast.located) -> ignore (Scope.define code x.it)) parameters;
  lambda.code <- Checks.statements { env with code } at body;
  lambda.slots <- Scope.slots code
