open Dolphin_semantics
open Dolphin_trace
module Names = Map.Make (String)

type t = {
  header : Header.t;
  replay : Replay.t;
  history : History.t;
  pending : Transition.event option;
  interrupted : bool;
  clock : float * string;
  kept : int;
  notes : int;
}

type trouble = Over of Request.ending | Changed | No_run of Journal_verdict.t

(* The part read so far. *)
type reading = {
  its_header : Header.t;
  after : Replay.t;  (* all lines *)
  reversed : History.t;
  held : (Entry.t * Replay.t) option;  (* the latest line, if that is an event, and the state before it *)
  its_clock : float * string;
  ran : string;  (* the hash of the program that ran last *)
  whole : int;  (* bytes, without [held] *)
  notes_of_whole : int;
}

(* The additions of a line to the history, latest first. *)
let remember (entry : Entry.t) replay history =
  let add what = { History.time = Entry.time entry; what } :: history in
  match entry with
  | Header _ | Partial _ | Label _ | Act _ | Resumed _ | End _ -> history
  | Vehicle { state; _ } -> add (Saw state)
  | Note { vehicle; note; _ } -> add (Noted (vehicle, note))
  | Event _ -> Option.fold (Replay.event replay) ~none:history ~some:(fun event -> add (Happened event))
  | Transition { index; _ } -> (
      match Replay.latest replay with
      | Some (_, t) when t.effects <> [] -> add (Asked { number = index; effects = t.effects })
      | Some _ | None -> history)

(* An event is reported with its transition: a run does not go on with an event alone. *)
let take tell reader r (entry : Entry.t) after =
  let r' = { r with after; reversed = remember entry after r.reversed } in
  match entry with
  | Event _ -> { r' with held = Some (entry, r.after) }
  | Header _ | Partial _ | Label _ | Vehicle _ | Transition _ | Note _ | Act _ | Resumed _ | End _ ->
    Option.iter (fun (event, _) -> tell event r.after) r.held;
    tell entry after;
    let r' = { r' with held = None; whole = Journal.whole reader; notes_of_whole = Journal.notes reader } in
    (match entry with
     | Resumed { time; at; program } -> { r' with its_clock = (time, at); ran = program.hash }
     | Header _ | Partial _ | Label _ | Vehicle _ | Event _ | Transition _ | Note _ | Act _ | End _ -> r')

(* The last event is a request to end, whose transition was not written. *)
let is_interrupted r =
  match r.held with Some (Event { event = Interruption { stuck = false }; _ }, _) -> true | Some _ | None -> false

let finish r =
  match Replay.ending r.after with
  | Some ending -> Error (Over ending)
  | None ->
    Ok
      { header = r.its_header;
        replay = (match r.held with Some (_, before) -> before | None -> r.after);
        history = List.rev r.reversed;
        pending = Replay.event r.after;
        interrupted = is_interrupted r;
        clock = r.its_clock;
        kept = r.whole;
        notes = r.notes_of_whole }

let read ?(tell = fun _ _ -> ()) ?(changed = false) program ~hash reader =
  (* That the program is another one explains whatever does not fit. *)
  let judge r result = if changed || r.ran = hash then result () else Error Changed in
  let rec go r =
    let before = Journal.whole reader in
    match Journal.next reader with
    (* A last line without its end may look whole: but its deed was not done yet. *)
    | Line _ when Journal.whole reader = before -> judge r (fun () -> finish r)
    | Torn _ | End_of_file -> judge r (fun () -> finish r)
    | Wrong { number; why } -> Error (No_run (Unreadable { number; why }))
    | Line { number; entry } -> (
        match Replay.feed r.after entry with
        | Ok after -> go (take tell reader r entry after)
        | Error mismatch ->
          judge r (fun () ->
              Error (No_run (No_run { number; entry; transitions = Replay.transitions r.after; mismatch }))))
  in
  let start = Replay.start ~hash program in
  match Journal.next reader with
  | Line { entry = Header header as entry; _ } when Journal.whole reader > 0 ->
    let after = Result.value (Replay.feed start entry) ~default:start in
    tell entry after;
    go
      { its_header = header; after; reversed = []; held = None; its_clock = (0., header.started);
        ran = header.program.hash; whole = Journal.whole reader; notes_of_whole = 0 }
  | Line { number; _ } | Torn number -> Error (No_run (Unreadable { number; why = "not even its first line is whole" }))
  | End_of_file -> Error (No_run (Unreadable { number = 1; why = "the journal is empty" }))
  | Wrong { number; why } -> Error (No_run (Unreadable { number; why }))

let seen r =
  let add found { History.time; what } =
    match what with
    | Saw state -> Names.add state.World.id (time, state) found
    | Noted _ | Happened _ | Asked _ -> found
  in
  List.map snd (Names.bindings (List.fold_left add Names.empty r.history))

let pp_trouble ppf = function
  | Over ending ->
    Format.fprintf ppf "this run is over: it ended %s%s" ending.how
      (match ending.message with None | Some "" -> "" | Some message -> ": " ^ message)
  | Changed ->
    Format.pp_print_string ppf
      "this run was of another program, or the program has changed since; --force-prefix goes on with it if what \
       happened so far is the beginning of a run of this one, too"
  | No_run verdict -> Journal_verdict.pp ppf verdict
