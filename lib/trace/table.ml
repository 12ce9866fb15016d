open Dolphin_semantics

(* {1 Cells} *)

type actor = Program | Vehicle of string
type row = { time : float; cells : (actor * string) list }

let most_columns = 8
let widest = 30
let widest_of_program = 48

(* The lines of [text], none longer than [n] characters; broken between words where that is possible. *)
let wrap n text =
  let rec add lines line = function
    | [] -> List.rev (line :: lines)
    | word :: words when Phrase.width word > n ->
      let head, rest = Phrase.split n word in
      add (if line = "" then lines else line :: lines) head (rest :: words)
    | word :: words when line = "" -> add lines word words
    | word :: words when Phrase.width line + 1 + Phrase.width word <= n -> add lines (line ^ " " ^ word) words
    | word :: words -> add (line :: lines) word words
  in
  add [] "" (String.split_on_char ' ' (Phrase.one_line text))

(* {1 Rows} *)

type state = {
  mutable cause : Event.t option;
  silent : (string, unit) Hashtbl.t;
  unready : (string, string) Hashtbl.t;
  mutable picked : string list;  (* latest first *)
  mutable rows : row list;  (* latest first *)
}

let add t time cells = if cells <> [] then t.rows <- { time; cells } :: t.rows
let vehicles vs = String.concat ", " vs

let amount = Dolphin_semantics.Value.amount

let of_request cause : Request.t -> _ = function
  | Start { vehicle; plan } -> [ (Vehicle vehicle, "┌ " ^ plan) ]
  | Stop v -> [ (Vehicle v, "└ stopped") ]
  | Bind vs -> (
      match cause with
      | Some (Event.Recruited _) -> List.map (fun v -> (Vehicle v, "recruited")) vs
      | Some _ | None -> (Program, "picks " ^ vehicles vs) :: List.map (fun v -> (Vehicle v, "picked")) vs)
  | Release vs -> (Program, "releases " ^ vehicles vs) :: List.map (fun v -> (Vehicle v, "released")) vs
  | Say text -> [ (Program, "says: " ^ text) ]
  | Ask prompt -> [ (Program, "asks: " ^ prompt) ]
  | Call what -> [ (Program, "calls " ^ what) ]
  | Look_for what -> [ (Program, "looks for " ^ what) ]
  | Set_connection_timeout { vehicles = None; seconds } ->
    [ (Program, Printf.sprintf "connection timeout %s s" (amount seconds)) ]
  | Set_connection_timeout { vehicles = Some vs; seconds } ->
    [ (Program, Printf.sprintf "connection timeout %s s for %s" (amount seconds) (vehicles vs)) ]
  | Put_question { prompt; _ } -> [ (Program, "asks: " ^ prompt) ]
  | Withdraw_question _ -> [ (Program, "withdraws its question") ]
  | End _ | Set_timer _ | Cancel_timer _ -> []

let of_cause : Event.t option -> _ = function
  | Some (Done v) -> [ (Vehicle v, "└ done") ]
  | Some (Failed { vehicle; why }) -> [ (Vehicle vehicle, "✗ " ^ why) ]
  | Some (Answer text) -> [ (Program, "is answered: " ^ text) ]
  | Some (Confirmation { yes; _ }) -> [ (Program, "is answered: " ^ if yes then "yes" else "no") ]
  | Some (No_answer why | No_confirmation { why; _ }) -> [ (Program, "gets no answer: " ^ why) ]
  | Some (Reply json) -> [ (Program, "is told " ^ Dolphin_json.Canonical.to_string json) ]
  | Some (No_reply why) -> [ (Program, "gets no reply: " ^ why) ]
  | Some (Input { key; value }) ->
    [ (Program, Printf.sprintf "gets %s: %s" key (Dolphin_json.Canonical.to_string value)) ]
  | Some (Interruption { stuck }) -> [ (Program, if stuck then "is stuck" else "is interrupted") ]
  | Some (Recruited { vehicle; _ }) -> [ (Program, "recruits " ^ vehicle) ]
  | Some (Timer _) | None -> []

(* Conditions and timers are seen by their consequences; those without any are named. *)
let of_label (s : Step.t) =
  let starts prefix =
    let n = String.length prefix in
    String.length s.label >= n && String.sub s.label 0 n = prefix
  in
  if s.label = "timeout" then [ (Program, "time is up") ]
  else if s.label = "check" then [ (Program, "a condition holds") ]
  else if starts "check" && List.mem "REPEAT-AGAIN" s.rules then [ (Program, "another round") ]
  else if starts "cut" && List.mem "ASSURE-CUT" s.rules then [ (Program, "assure: the condition does not hold") ]
  else if starts "cut" then [ (Program, "until: the condition holds") ]
  else if starts "broken(" then [ (Program, "error: " ^ String.sub s.label 7 (String.length s.label - 8)) ]
  else if starts "pause(" then [ (Program, s.label) ]
  else []

(* Neighbouring cells of different actors stand in one row. *)
let rows_of cells =
  let place rows ((actor, _) as cell) =
    match rows with
    | row :: others when not (List.mem_assoc actor row) -> (cell :: row) :: others
    | rows -> [ cell ] :: rows
  in
  List.rev_map List.rev (List.fold_left place [] cells)

let of_step t time (s : Step.t) =
  let pairs verb = function [] -> [] | xs -> [ (Program, verb ^ " " ^ vehicles xs) ] in
  let of_bound : Request.t -> unit = function
    | Bind vs -> List.iter (fun v -> if not (List.mem v t.picked) then t.picked <- v :: t.picked) vs
    | _ -> ()
  in
  List.iter of_bound s.requests;
  let cells =
    of_cause t.cause @ of_label s @ pairs "consumes" s.consumed @ pairs "posts" s.posted
    @ List.concat_map (of_request t.cause) s.requests
  in
  t.cause <- None;
  List.iter (add t time) (rows_of cells)

let of_link t time (state : World.vehicle_state) =
  let was_silent = Hashtbl.mem t.silent state.id in
  if was_silent && state.connected then begin
    Hashtbl.remove t.silent state.id;
    add t time [ (Vehicle state.id, "link back") ]
  end
  else if (not was_silent) && not state.connected then begin
    Hashtbl.replace t.silent state.id ();
    add t time [ (Vehicle state.id, "no link") ]
  end

let of_readiness t time (state : World.vehicle_state) =
  if state.connected && state.unready <> Hashtbl.find_opt t.unready state.id then begin
    Hashtbl.remove t.unready state.id;
    Option.iter (Hashtbl.replace t.unready state.id) state.unready;
    add t time [ (Vehicle state.id, Option.value state.unready ~default:"ready") ]
  end

let of_entry t (entry : Entry.t) =
  match entry with
  | Header _ | Partial _ -> ()
  | Label { time; label } -> add t time [ (Program, label) ]
  | Event { event; _ } -> t.cause <- Some event
  | Transition { time; step; _ } -> of_step t time step
  | Vehicle { time; state } -> of_link t time state; of_readiness t time state
  | Note _ -> ()
  | Act { time; act } -> add t time [ (Program, Act.words act) ]
  | Resumed { time; at; _ } -> add t time [ (Program, "is resumed, at " ^ at) ]
  | End { time; ending; _ } ->
    let text = match ending.message with None | Some "" -> ending.how | Some text -> ending.how ^ ": " ^ text in
    add t time [ (Program, text) ]

(* {1 The page} *)

let clock_width = 8

(* The column of [v] beside others' steps: whether it is at work. *)
let print_columns ppf picked rows =
  let cells_of actor row = List.filter_map (fun (who, text) -> if who = actor then Some text else None) row.cells in
  let widest_cell limit actor name =
    let cells = List.concat_map (cells_of actor) rows in
    min limit (List.fold_left (fun n text -> max n (Phrase.width (Phrase.one_line text))) (Phrase.width name) cells)
  in
  let columns =
    (Program, "program", widest_cell widest_of_program Program "program")
    :: List.map (fun v -> (Vehicle v, v, widest_cell widest (Vehicle v) v)) picked
  in
  let working = Hashtbl.create 8 in
  let line time cells =
    let rec trim text n = if n > 0 && text.[n - 1] = ' ' then trim text (n - 1) else String.sub text 0 n in
    let text = String.concat "  " (time :: List.map2 (fun (_, _, n) cell -> Phrase.pad n cell) columns cells) in
    Format.fprintf ppf "%s@\n" (trim text (String.length text))
  in
  let print_row previous row =
    let clock = Phrase.time row.time in
    let cell (actor, _, n) =
      let idle = if Hashtbl.mem working actor then "│" else "" in
      match cells_of actor row with
      | [] -> ([ idle ], idle)
      | texts ->
        let text = String.concat "; " texts in
        let begins mark = String.length text >= 3 && String.sub text 0 3 = mark in
        let lines =
          match actor with
          | Vehicle _ when begins "┌" || begins "└" || begins "✗" || idle = "" -> wrap n text
          | Vehicle _ -> wrap n (idle ^ " " ^ text)
          | Program -> wrap n text
        in
        if begins "┌" then Hashtbl.replace working actor ()
        else if begins "└" || begins "✗" then Hashtbl.remove working actor;
        (lines, if Hashtbl.mem working actor then "│" else "")
    in
    let cells = List.map cell columns in
    let height = List.fold_left (fun n (lines, _) -> max n (List.length lines)) 1 cells in
    for i = 0 to height - 1 do
      let nth (lines, further) = Option.value (List.nth_opt lines i) ~default:further in
      let shown = if i = 0 && clock <> previous then clock else "" in
      let time = Printf.sprintf "%*s" clock_width shown in
      line time (List.map nth cells)
    done;
    clock
  in
  line (Printf.sprintf "%*s" clock_width "time") (List.map (fun (_, name, _) -> Phrase.one_line name) columns);
  ignore (List.fold_left print_row "" rows)

let print_list ppf rows =
  let name = function Program -> "program" | Vehicle v -> v in
  let cells = List.concat_map (fun row -> List.map (fun (who, text) -> (row.time, name who, text)) row.cells) rows in
  let column = List.fold_left (fun n (_, who, _) -> max n (min widest (Phrase.width who))) 7 cells in
  let print (time, who, text) =
    Format.fprintf ppf "%*s  %s  %s@\n" clock_width (Phrase.time time)
      (Phrase.pad column (Phrase.one_line who))
      (Phrase.one_line text)
  in
  List.iter print cells

let print ppf entries =
  let t = { cause = None; silent = Hashtbl.create 8; unready = Hashtbl.create 8; picked = []; rows = [] } in
  List.iter (of_entry t) entries;
  let picked = List.rev t.picked in
  let is_shown (actor, _) = match actor with Program -> true | Vehicle v -> List.mem v picked in
  let shown row =
    match List.filter is_shown row.cells with [] -> None | cells -> Some { row with cells }
  in
  let rows = List.filter_map shown (List.rev t.rows) in
  if List.length picked <= most_columns then print_columns ppf picked rows else print_list ppf rows

let print_transitions ppf (entry : Entry.t) =
  match entry with
  | Transition { index; time; step; ways = _ } ->
    let place = Option.fold ~none:"" ~some:Step.text_of_place step.at in
    Format.fprintf ppf "%6d  %*s  %-7s  %s  %s@\n" index clock_width (Phrase.time time) place
      (String.concat ", " step.rules) (Phrase.one_line step.label)
  | Header _ | Partial _ | Label _ | Vehicle _ | Event _ | Note _ | Act _ | Resumed _ | End _ -> ()
