let python =
  match Sys.getenv_opt "DOLPHIN_IMCPY" with
  | None | Some "" -> Error "no imcpy, DOLPHIN_IMCPY is not set"
  | Some python -> Ok python

let cases all = Requiring.cases python (List.map (fun (name, run) -> (name, fun python -> run ~python)) all)
