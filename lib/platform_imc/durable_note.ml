type t =
  | Asked of { plan : string; request : int; before : (string * bool) option }
  | Taken of { request : int }
  | Runs of { request : int }
  | Over of { request : int }
  | May_run of { plan : string; request : int }

let is_write_ahead = function Asked _ -> true | Taken _ | Runs _ | Over _ | May_run _ -> false

let to_json n : Yojson.Safe.t =
  match n with
  | Asked { plan; request; before } ->
    let before =
      match before with
      | None -> []
      | Some (plan, busy) -> [ ("before", `String plan); ("busy", `Bool busy) ]
    in
    `Assoc (("asked", `String plan) :: ("request", `Int request) :: before)
  | Taken { request } -> `Assoc [ ("taken", `Int request) ]
  | Runs { request } -> `Assoc [ ("runs", `Int request) ]
  | Over { request } -> `Assoc [ ("over", `Int request) ]
  | May_run { plan; request } -> `Assoc [ ("may-run", `String plan); ("request", `Int request) ]

let of_json : Yojson.Safe.t -> t option = function
  | `Assoc [ ("asked", `String plan); ("request", `Int request) ] -> Some (Asked { plan; request; before = None })
  | `Assoc [ ("asked", `String plan); ("request", `Int request); ("before", `String name); ("busy", `Bool busy) ] ->
    Some (Asked { plan; request; before = Some (name, busy) })
  | `Assoc [ ("taken", `Int request) ] -> Some (Taken { request })
  | `Assoc [ ("runs", `Int request) ] -> Some (Runs { request })
  | `Assoc [ ("over", `Int request) ] -> Some (Over { request })
  | `Assoc [ ("may-run", `String plan); ("request", `Int request) ] -> Some (May_run { plan; request })
  | _ -> None

let lingering notes =
  let add found (v, note) =
    match note with
    | May_run { plan; request } -> (v, (plan, request)) :: List.remove_assoc v found
    | Asked _ -> List.remove_assoc v found
    | Over { request } -> List.filter (fun (w, (_, other)) -> w <> v || other <> request) found
    | Taken _ | Runs _ -> found
  in
  List.rev (List.fold_left add [] notes)

type knowledge = {
  request : int;
  before : (string * bool) option;
  taken : bool;
  runs : bool;
  over : bool;
}

(* A request that is sent again is kept again; it is the same one. *)
let add ~plan known = function
  | Asked a -> (
      match known with
      | Some k when k.request = a.request -> known
      | _ when a.plan = plan ->
        Some { request = a.request; before = a.before; taken = false; runs = false; over = false }
      | _ -> known)
  | Taken { request } -> Option.map (fun k -> if k.request = request then { k with taken = true } else k) known
  | Runs { request } -> Option.map (fun k -> if k.request = request then { k with runs = true } else k) known
  | Over { request } -> Option.map (fun k -> if k.request = request then { k with over = true } else k) known
  | May_run _ -> known

let knowledge ~plan notes = List.fold_left (add ~plan) None (List.rev notes)
