module Canonical = Dolphin_json.Canonical

(* The text in their parentheses is for people: each implementation has its own words. *)
let worded = [ "broken"; "fault"; "cannot-execute"; "no-vehicles"; "pick" ]

let label expected seen =
  String.equal expected seen
  || List.mem expected worded
     &&
     let opening = expected ^ "(" in
     let n = String.length opening in
     String.length seen >= n && String.sub seen 0 n = opening

let without name = List.filter (fun (other, _) -> other <> name)

(* [expected] and [seen] without what is wording. *)
let comparable (expected : Yojson.Safe.t) (seen : Yojson.Safe.t) : Yojson.Safe.t * Yojson.Safe.t =
  match expected, seen with
  | `Assoc (("look-for", _) :: _), `Assoc (("look-for", _) :: _) -> (`Null, `Null)
  | `Assoc [ ("end", `Assoc e) ], `Assoc [ ("end", `Assoc s) ] when not (List.mem_assoc "message" e) ->
    (`Assoc e, `Assoc (without "message" s))
  | expected, seen -> (expected, seen)

(* Numbers are equal by value, whichever way they are written. *)
let rec plain (json : Yojson.Safe.t) : Yojson.Safe.t =
  match json with
  | `Float x -> Canonical.number x
  | `List items -> `List (List.map plain items)
  | `Assoc members -> `Assoc (List.map (fun (name, x) -> (name, plain x)) members)
  | json -> json

let text json = Canonical.to_string (Yojson.Safe.sort (plain json))

let same_effect expected seen =
  let expected, seen = comparable expected seen in
  String.equal (text expected) (text seen)

let same_effects expected seen = List.length expected = List.length seen && List.for_all2 same_effect expected seen

let same_ending (how, message) seen =
  match seen with
  | None -> false
  | Some (how', message') -> how = how' && (message = None || message = message')

let bracketed show xs = "[" ^ String.concat ", " (List.map show xs) ^ "]"
let assignment (name, x) = name ^ ": " ^ x

let show_ending = function
  | None -> "none"
  | Some (how, None) -> how
  | Some (how, Some message) -> how ^ ": " ^ message

let difference (e : Case.seen) (t : Dialogue.transition) =
  let differs what same show expected seen =
    match expected with
    | Some expected when not (same expected seen) ->
      Some (Printf.sprintf "%s: expected %s, seen %s" what (show expected) (show seen))
    | Some _ | None -> None
  in
  let among wanted there = List.for_all (fun x -> List.mem x there) wanted in
  let first checks = List.find_map (fun check -> check ()) checks in
  first
    [ (fun () -> differs "the label" label Fun.id (Some e.label) t.label);
      (fun () -> differs "the rule" ( = ) (bracketed Fun.id) e.rule t.rules);
      (fun () -> differs "the effects" same_effects (bracketed Canonical.to_string) e.effects t.effects);
      (fun () -> differs "A" ( = ) (bracketed assignment) e.running (Dialogue.running t.next));
      (fun () -> differs "B" ( = ) (bracketed Fun.id) e.bound (Dialogue.bound t.next));
      (fun () -> differs "N" ( = ) (bracketed Fun.id) e.pairs (Dialogue.pairs t.next));
      (fun () -> differs "the store" among (bracketed assignment) e.store (Dialogue.store t.next));
      (fun () ->
         differs "the end"
           (fun expected seen -> match expected with None -> true | Some expected -> same_ending expected seen)
           show_ending
           (Option.map Option.some e.ending)
           (Dialogue.ending t.next)) ]
