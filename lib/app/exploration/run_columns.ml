module Columns = Dolphin_display.Columns

let print program ~steps ~cycle =
  let print = List.iter print_endline in
  print (Columns.lines program steps);
  if cycle <> [] then begin
    print_endline "and from there, again and again:";
    print (Columns.lines ~first:(List.length steps + 1) program cycle)
  end

let print_waiting (program : Dolphin_semantics.Core.program) steps =
  match List.rev steps with
  | ({ next = { control = Executing (_, residual); _ }; _ } : Dolphin_semantics.Transition.t) :: _ ->
    let guard (c : Dolphin_semantics.Core.closure) =
      Format.printf "waits for the condition at %a@." Dolphin_syntax.Location.pp
        program.locations.(c.lambda.lambda_site)
    in
    List.iter guard (Dolphin_runtime.Driver.guards residual)
  | _ -> ()
