open Dolphin_lts

let string text = Dolphin_json_text.Canonical.to_string (`String text)

(* [separated out write n] is [write 0], ... [write (n - 1)], with commas between. *)
let separated out write n =
  for i = 0 to n - 1 do
    if i > 0 then out ",";
    write i
  done

let write out g =
  out "{\"format\":\"dolphin-lts\",\"version\":1,\n";
  out (Printf.sprintf "\"initial\":%d,\"states\":%d,\n\"labels\":[" (Graph.initial g) (Graph.states g));
  separated out (fun l -> out (string (Graph.label g l))) (Graph.labels g);
  out "],\n\"transitions\":[";
  let first = ref true in
  Graph.iter g (fun s l s' ->
      out (Printf.sprintf "%s[%d,%d,%d]" (if !first then "\n" else ",\n") s l s');
      first := false);
  out "]";
  (match Graph.text g with
   | None -> ()
   | Some text ->
     out ",\n\"texts\":[";
     separated out
       (fun s ->
          out "\n";
          out (string (text s)))
       (Graph.states g);
     out "]");
  out "}\n"

let to_string g =
  let b = Buffer.create (16 * (Graph.transitions g + 16)) in
  write (Buffer.add_string b) g;
  Buffer.contents b

type error =
  | Not_json of string
  | Not_a_graph
  | Version of int
  | Expected of { what : string; where : string }
  | No_such_state of { state : int; states : int; where : string }
  | No_such_label of { label : int; labels : int; where : string }

exception Problem of error

let fail error = raise_notrace (Problem error)
let expected what where = fail (Expected { what; where })
let quoted name = Printf.sprintf "%S" name
let natural ~where = function `Int n when n >= 0 && n <= Int_vector.limit -> n | _ -> expected "a number from 0" where
let text ~where = function `String text -> text | _ -> expected "a string" where
let elements ~where = function `List elements -> elements | _ -> expected "a list" where
let member members name = List.assoc_opt name members

let needed members name read =
  match member members name with
  | Some value -> read ~where:(quoted name) value
  | None -> expected (quoted name) "the object"

let transition b ~states ~labels i value =
  let where = Printf.sprintf "transition %d" i in
  match value with
  | `List [ s; l; s' ] ->
    let state value =
      let state = natural ~where value in
      if state >= states then fail (No_such_state { state; states; where });
      state
    in
    let label = natural ~where l in
    if label >= Array.length labels then fail (No_such_label { label; labels = Array.length labels; where });
    Graph.Builder.add_numbered b (state s) labels.(label) (state s')
  | _ -> expected "[source, label, target]" where

let texts ~states value =
  let where = quoted "texts" in
  let texts = Array.map (text ~where) (Array.of_list (elements ~where value)) in
  if Array.length texts <> states then expected (Printf.sprintf "%d strings, one for each state" states) where;
  Array.get texts

let graph members =
  if member members "format" <> Some (`String "dolphin-lts") then fail Not_a_graph;
  let version = needed members "version" natural in
  if version <> 1 then fail (Version version);
  let initial = needed members "initial" natural and states = needed members "states" natural in
  if initial >= states then fail (No_such_state { state = initial; states; where = quoted "initial" });
  let b = Graph.Builder.create () in
  let labels = Array.of_list (needed members "labels" elements) in
  let labels = Array.map (fun label -> Graph.Builder.label b (text ~where:(quoted "labels") label)) labels in
  List.iteri (transition b ~states ~labels) (needed members "transitions" elements);
  let text = Option.map (texts ~states) (member members "texts") in
  Graph.Builder.finish ~initial ~states ?text b

let of_string source =
  match Yojson.Safe.from_string source with
  | `Assoc members -> ( try Ok (graph members) with Problem error -> Error error)
  | _ -> Error Not_a_graph
  | exception Yojson.Json_error message -> Error (Not_json message)
  | exception Stack_overflow -> Error (Not_json "it is nested too deep")

let pp_error ppf = function
  | Not_json message -> Fmt.pf ppf "this is not JSON: %s" message
  | Not_a_graph -> Fmt.string ppf "this is not a graph: expected an object with \"format\": \"dolphin-lts\""
  | Version version -> Fmt.pf ppf "this is version %d of the format; expected version 1" version
  | Expected { what; where } -> Fmt.pf ppf "expected %s in %s" what where
  | No_such_state { state; states; where } ->
    Fmt.pf ppf "there is no state %d in %s: there are %d, numbered from 0" state where states
  | No_such_label { label; labels; where } ->
    Fmt.pf ppf "there is no label %d in %s: there are %d, numbered from 0" label where labels
