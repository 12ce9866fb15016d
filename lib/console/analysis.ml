open Dolphin_app
open Dolphin_json
open Lwt.Infix
open Exchange

type subject = Exploration | Timing | Graph | Replacement

type order = {
  subject : subject;
  seconds : int;
  arguments : string list;
  inputs : string list;
  program : string;
  fleet : string option;
  set : (string * string) list;
  hash : string;
}

type state = Running | Cancelled | Over of (string, string) result

type t = {
  order : order;
  process : Lwt_process.process_full;
  changed : unit -> unit;
  conclude : text:string -> witness:string option -> (string, string) result Lwt.t;
  witness : string;  (* the file of the run that is shown *)
  mutable progress : string;
  mutable state : state;
  mutable found : string option;  (* the contents of that file *)
}

let order e = e.order
let goes_on e = match e.state with Running -> true | Cancelled | Over _ -> false
let shown e = e.found

(* {1 Orders in JSON} *)

let subjects = [ (Exploration, "exploration"); (Timing, "timing"); (Graph, "graph"); (Replacement, "replacement") ]
let subject_name subject = List.assoc subject subjects

let subject_of json =
  let of_name name = List.find_opt (fun (_, known) -> known = name) subjects in
  Result.bind (Field.text json) (fun name ->
      Option.to_result ~none:(name ^ " is not a subject") (Option.map fst (of_name name)))

let json_of_order o : json =
  let set = List.map (fun (name, text) -> (name, `String text)) o.set in
  `Assoc
    [ ("subject", `String (subject_name o.subject)); ("seconds", `Int o.seconds);
      ("arguments", Field.texts o.arguments); ("inputs", Field.texts o.inputs); ("program", `String o.program);
      ("fleet", Field.of_option (fun path -> `String path) o.fleet); ("set", `Assoc set); ("hash", `String o.hash) ]

let order_of_json json =
  let* found = needed (Field.members json) in
  let* subject = get subject_of "subject" found in
  let* seconds = get Field.whole "seconds" found in
  let* arguments = get (Field.list Field.text) "arguments" found in
  let* inputs = get (Field.list Field.text) "inputs" found in
  let* program = get Field.text "program" found in
  let* fleet = optional Field.text "fleet" found in
  let* set = set found in
  let* hash = get Field.text "hash" found in
  Ok { subject; seconds; arguments; inputs; program; fleet; set; hash }

(* {1 The process} *)

let rec follow_progress e told =
  Lwt_io.read_line_opt e.process#stderr >>= function
  | None -> Lwt.return (List.rev told)
  | Some line ->
    e.progress <- line;
    e.changed ();
    follow_progress e (if List.length told < 100 then line :: told else told)

let longest = 32 * 1024 * 1024

let rec read_all e buffer =
  Lwt_io.read ~count:65_536 e.process#stdout >>= function
  | "" -> Lwt.return (Buffer.contents buffer)
  | text ->
    Buffer.add_string buffer text;
    if Buffer.length buffer <= longest then read_all e buffer
    else begin
      e.process#kill Sys.sigkill;
      Lwt.return ""
    end

let over e result =
  if e.state = Running then e.state <- Over result;
  e.changed ()

(* The witness is read as it is: its parts matter to the process that shows it and to the run that enacts it. *)
let conclude e text told =
  let witness = if Sys.file_exists e.witness then Some e.witness else None in
  e.found <- Option.bind witness (fun path -> Result.to_option (Text_file.read path));
  let why found = if told = [] then found else String.concat "\n" told in
  e.conclude ~text ~witness >|= fun result ->
  (try Sys.remove e.witness with Sys_error _ -> ());
  over e (Result.map_error why result)

let start ~dolphin ~changed ~conclude:concluding order =
  let witness = Filename.temp_file "dolphin-console" ".witness" in
  Sys.remove witness;
  let limits =
    match order.subject with
    | Exploration | Timing -> [ "--timeout"; string_of_int order.seconds; "--trace"; witness ]
    | Replacement -> [ "--timeout"; string_of_int order.seconds ]
    | Graph -> []
  in
  let command = (dolphin :: order.arguments) @ limits @ order.inputs in
  let process = Lwt_process.open_process_full (dolphin, Array.of_list command) in
  let e =
    { order; process; changed; conclude = concluding; witness; progress = ""; state = Running; found = None }
  in
  let whole () =
    Lwt_io.close process#stdin >>= fun () ->
    Lwt.both (read_all e (Buffer.create 4096)) (follow_progress e []) >>= fun (text, told) ->
    process#close >>= fun _ -> conclude e text told
  in
  let failed error = over e (Error (Printexc.to_string error)); Lwt.return_unit in
  Lwt.async (fun () -> Lwt.catch whole failed);
  e

let inputs (program : Program_file.t) (fleet : Fleet_file.t) =
  let set = List.concat_map (fun (name, value) -> [ "--set"; name ^ "=" ^ value ]) program.set in
  let fleet = Option.fold fleet.path ~none:[] ~some:(fun path -> [ "--fleet"; path ]) in
  fleet @ set @ [ "--"; program.path ]

let cancel e =
  if goes_on e then begin
    e.state <- Cancelled;
    e.process#terminate;
    e.changed ()
  end

(* {1 In JSON} *)

let progress e : Field.members =
  let state =
    match e.state with
    | Running -> "running"
    | Cancelled -> "cancelled"
    | Over (Ok _) -> "over"
    | Over (Error _) -> "failed"
  in
  [ ("state", `String state); ("progress", `String e.progress) ]

let to_text e =
  let of_order = [ ("program", `String e.order.program); ("hash", `String e.order.hash) ] in
  let members : Field.members = of_order @ progress e in
  let text members = Canonical.to_string (`Assoc members) in
  match e.state with
  | Running | Cancelled -> text members
  | Over (Error why) -> text (members @ [ ("error", `String why) ])
  | Over (Ok found) ->
    let before = text members in
    String.sub before 0 (String.length before - 1) ^ "," ^ String.sub found 1 (String.length found - 1)
