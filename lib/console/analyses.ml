open Dolphin_json
open Field
open Exchange

let longest = 3600
let most_states = 2_000

let within what least most n =
  if n >= least && n <= most then Ok () else bad (Printf.sprintf "%s from %d to %d" what least most)

let kind (subject : Hall.subject) found : (Analysis.kind, refusal) result =
  match subject with
  | Exploration -> Ok Exploration
  | Timing -> Result.map (fun deadline -> Analysis.Timing { deadline }) (optional Field.text "deadline" found)
  | Graph ->
    let* states = optional whole "states" found in
    let states = Option.value states ~default:300 in
    Result.map (fun () -> Analysis.Graph { states }) (within "a graph has states" 1 most_states states)

let start subject h found =
  let* path = get Field.text "program" found in
  let* named = optional Field.text "fleet" found in
  let* seconds = optional whole "seconds" found in
  let* faults = optional Field.text "faults" found in
  let* set = set found in
  let* kind = kind subject found in
  let seconds = Option.value seconds ~default:60 in
  let* () = within "it takes seconds" 1 longest seconds in
  let* () =
    match Hall.analysis h subject with
    | Some a when Analysis.goes_on a -> refuse 409 "busy" "this goes on: one at a time"
    | Some _ | None -> Ok ()
  in
  let* program = program h ~set path in
  let* fleet = fleet h ~program:program.path named in
  let* program = Exchange.within fleet program in
  let dolphin = (Hall.settings h).dolphin in
  let changed () = Hall.changed h in
  Hall.set_analysis h subject (Analysis.start ~dolphin ~changed { kind; faults; seconds } program fleet);
  Ok (`Assoc [])

let to_json h a =
  let path = Folder.inside (folder h) (Analysis.program a).path in
  match Analysis.to_json a with
  | `Assoc found -> `Assoc (("program", of_option (fun path -> `String path) path) :: found)
  | json -> json

let result subject h _ = Ok (of_option (to_json h) (Hall.analysis h subject))

let cancel subject h _ =
  Option.iter Analysis.cancel (Hall.analysis h subject);
  Ok (`Assoc [])
