open Dolphin_imc

(* {1 The recording} *)

type heard = { time : float; packet : Packet.t }

let recorded =
  lazy
    (let channel = open_in "../platform_imc/data/fleet.jsonl" in
     let of_hex text =
       String.init (String.length text / 2) (fun i -> Char.chr (int_of_string ("0x" ^ String.sub text (2 * i) 2))) in
     let heard json =
       let open Yojson.Safe.Util in
       match Packet.decode (of_hex (to_string (member "hex" json))) with
       | Ok packet -> { time = to_number (member "t" json); packet }
       | Error e -> Alcotest.failf "%a" Error.pp_decode e
     in
     let rec read found =
       match input_line channel with
       | text -> read (heard (Yojson.Safe.from_string text) :: found)
       | exception End_of_file -> close_in channel; List.rev found
     in
     read [])

let console = 0x5A0E

type request = { at : float; message : Message.t; number : int; plan : string; inline : bool }

(* Each once: vehicles send requests on to all consoles. *)
let requests id =
  let start h =
    match h.packet.content with
    | Message (Plan_control { type_ = Request; op = Start; request_id = number; plan_id = plan; arg; _ } as message)
      when h.packet.src = console && h.packet.dst = id ->
      Some { at = h.time; message; number; plan; inline = arg <> None }
    | Message _ | Unknown _ -> None
  in
  let once found r = if List.exists (fun x -> x.number = r.number) found then found else r :: found in
  List.rev (List.fold_left once [] (List.filter_map start (Lazy.force recorded)))

(* The messages of the vehicle from its first request on. *)
let said id =
  let first = (List.hd (requests id)).at in
  List.filter (fun h -> h.packet.src = id && h.time >= first) (Lazy.force recorded)

let reply r info h =
  match h.packet.content with
  | Message (Plan_control { type_ = Success; request_id; info = text; _ }) -> request_id = r.number && text = info
  | Message _ | Unknown _ -> false

(* Seconds from the request to a message. *)
let delay heard r is_it =
  match List.find_opt is_it heard with
  | Some h -> h.time -. r.at
  | None -> Alcotest.failf "%s: it is not said" r.plan

(* {1 The simulator in the same place} *)

let source id =
  let plan r =
    if r.inline then ""
    else Printf.sprintf "plan '%s', { duration %.3f.seconds }\n" r.plan (delay (said id) r (reply r "plan completed"))
  in
  "vehicle 'v', { type 'UUV'; at 41.1850, -8.7062; speed 1.5 }\n" ^ String.concat "" (List.map plan (requests id))

let replay id =
  let s = Harness.make (Harness.settings ~strict:true (source id)) in
  Harness.join s;
  Harness.beat_until s 10.;
  (* A plan may take a little longer here: the next request then comes as late. *)
  let ask late r =
    let late = Float.max late (Harness.now s -. r.at) in
    let at = r.at +. late in
    Harness.beat_until s at;
    Harness.send s r.message;
    Harness.beat_until s (at +. 1.);
    { r with at }
  in
  let first = (List.hd (requests id)).at in
  let asked = List.map (ask (10. -. first)) (requests id) in
  Harness.beat_until s (Harness.now s +. 1200.);
  let ours (h : Harness.heard) = { time = h.time; packet = h.packet } in
  let all = List.map ours (Harness.heard s) in
  let begun = (List.hd asked).at in
  (asked, List.filter (fun h -> h.packet.src = Harness.vehicle && h.time >= begun) all)

(* {1 Messages} *)

(* The deeds of the vehicles before the recording show in their first states and in
   whether a plan is new to them. *)
let story heard =
  let lines = Harness.summarise (List.map (fun h -> h.packet) heard) in
  List.filter (fun line -> Harness.kind line <> "store") lines

let of_kind prefix lines =
  let n = String.length prefix in
  List.filter (fun line -> String.length line > n && String.sub line 0 n = prefix) lines

let rec since start = function
  | line :: _ as lines when of_kind start [ line ] <> [] -> lines
  | _ :: lines -> since start lines
  | [] -> []

let vehicles = [ 0x1A; 0x1B; 0x1C; 0x1E ]

(* One vehicle sent its log book to another console only, as long as its first plan began. *)
let knew_us_late = 0x1C

let last n lines =
  let rest = List.length lines - n in
  List.filteri (fun i _ -> i >= rest) lines

let same prefix id () =
  let real = of_kind prefix (story (said id)) and ours = of_kind prefix (story (snd (replay id))) in
  let told = match prefix with "state" -> since "state READY" | "vehicle" -> since "vehicle MANEUVE" | _ -> Fun.id in
  let reached lines = if id = knew_us_late && of_kind "log" [ prefix ] <> [] then last (List.length real) lines else lines in
  Alcotest.(check (list string)) prefix (told real) (reached (told ours));
  Alcotest.(check bool) "something" true (told real <> [])

let kinds = [ "reply"; "state"; "vehicle"; "log Plan.Engine"; "log Supervisors.Vehicle" ]

(* {1 Times} *)

let executing r h =
  match h.packet.content with
  | Message (Plan_control_state { state = Executing; plan_id; _ }) -> plan_id = r.plan
  | Message _ | Unknown _ -> false

let ready r h =
  match h.packet.content with
  | Message (Plan_control_state { state = Ready; plan_id; _ }) -> plan_id = r.plan
  | Message _ | Unknown _ -> false

(* A request is answered at once, by both; the fleet file has the end of a plan. *)
let times id () =
  let asked, ours = replay id and real = said id in
  let compare_one r r' =
    let both name within is_it =
      Alcotest.(check (float within)) (r.plan ^ ": " ^ name) (delay real r (is_it r)) (delay ours r' (is_it r')) in
    both "loaded" 0.02 (fun r -> reply r "plan loaded");
    both "executing" 0.02 executing;
    if not r.inline then begin
      both "completed" 0.2 (fun r -> reply r "plan completed");
      both "ready again" 0.2 ready
    end
  in
  List.iter2 compare_one (requests id) asked

let tests =
  let case name f = Alcotest.test_case name `Quick (fun () -> List.iter (fun id -> f id ()) vehicles) in
  List.map (fun kind -> case kind (same kind)) kinds @ [ case "times" times ]
