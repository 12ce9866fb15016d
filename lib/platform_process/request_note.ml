open Dolphin_runtime

type t =
  | Asked of { request : string; plan : string }
  | Note of { request : string; note : Yojson.Safe.t }
  | Unsettled of { request : string; plan : Yojson.Safe.t }
  | Over of string

let text x : Yojson.Safe.t = `String x

let to_json ~platform kept : Yojson.Safe.t =
  let members =
    match kept with
    | Asked { request; plan } -> [ ("asked", text plan); ("request", text request) ]
    | Note { request; note } -> [ ("request", text request); ("note", note) ]
    | Unsettled { request; plan } -> [ ("unsettled", text request); ("plan", plan) ]
    | Over request -> [ ("over", text request) ]
  in
  `Assoc (("platform", text platform) :: members)

let of_json ~platform : Yojson.Safe.t -> t option = function
  | `Assoc (("platform", `String name) :: members) when name = platform -> (
      match members with
      | [ ("asked", `String plan); ("request", `String request) ] -> Some (Asked { request; plan })
      | [ ("request", `String request); ("note", note) ] -> Some (Note { request; note })
      | [ ("unsettled", `String request); ("plan", plan) ] -> Some (Unsettled { request; plan })
      | [ ("over", `String request) ] -> Some (Over request)
      | _ -> None)
  | _ -> None

let latest ~platform notes =
  let kept = List.filter_map (of_json ~platform) notes in
  let asked = function Asked { request; _ } -> Some request | Note _ | Unsettled _ | Over _ -> None in
  let note_on r = function
    | Note { request; note } when request = r -> Some note
    | Note _ | Asked _ | Unsettled _ | Over _ -> None
  in
  match List.find_map asked kept with
  | Some request when not (List.mem (Over request) kept) -> Some (request, List.filter_map (note_on request) kept)
  | Some _ | None -> None

let unsettled ~platform history =
  let add found { History.what; time = _ } =
    match what with
    | Noted (v, json) -> (
        match of_json ~platform json with
        | Some (Unsettled { request; plan }) -> (v, request, plan) :: found
        | Some (Over over) -> List.filter (fun (_, request, _) -> request <> over) found
        | Some (Asked _ | Note _) | None -> found)
    | Saw _ | Happened _ | Asked _ -> found
  in
  List.rev (List.fold_left add [] history)
