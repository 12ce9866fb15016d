module Formula = Dolphin_ltl.Formula

type t = { text : string; formula : int Formula.t; propositions : Proposition.t array }

let to_string f = f.text
let formula f = f.formula
let propositions f = f.propositions
let conditions f = List.filter_map Proposition.condition (Array.to_list f.propositions)
let names f v = Array.exists (fun p -> Proposition.names p v) f.propositions

(* The bits of a number are the propositions that hold: see [Product]. *)
let most_running = 62

let running propositions =
  List.sort_uniq Stdlib.compare (List.concat_map Proposition.running (Array.to_list propositions))

exception Unknown of string

let of_string program text =
  let known = Hashtbl.create 8 and propositions = ref [] in
  let place text =
    match Hashtbl.find_opt known text with
    | Some place -> place
    | None -> (
        match Proposition.of_string program text with
        | Error why -> raise (Unknown why)
        | Ok p ->
          let place = Hashtbl.length known in
          Hashtbl.add known text place;
          propositions := p :: !propositions;
          place)
  in
  match Result.map (Formula.map place) (Formula.of_string text) with
  | Error why | exception Unknown why -> Error why
  | Ok formula ->
    let propositions = Array.of_list (List.rev !propositions) in
    if List.length (running propositions) > most_running then
      Error (Printf.sprintf "it asks of more than %d plans whether they run" most_running)
    else Ok { text; formula; propositions }
