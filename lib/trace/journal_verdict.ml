open Dolphin_semantics

type t =
  | Run of { transitions : int; time : float; ending : Request.ending }
  | Prefix of { transitions : int; time : float; torn : bool }
  | No_run of { number : int; entry : Entry.t; transitions : int; mismatch : Replay.mismatch }
  | Possible of { lines : int; over : bool }
  | Impossible of { number : int; entry : Entry.t; lines : int; mismatch : Partial.mismatch }
  | Unknown of { number : int; most : int }
  | Unreadable of { number : int; why : string }

let most = 100_000

let over replay ~torn =
  let transitions = Replay.transitions replay and time = Replay.time replay in
  match Replay.ending replay with
  | Some ending when not torn -> Run { transitions; time; ending }
  | Some _ | None -> Prefix { transitions; time; torn }

let rec go reader replay =
  match Journal.next reader with
  | Line { number; entry } -> (
      match Replay.feed replay entry with
      | Ok replay -> go reader replay
      | Error mismatch -> No_run { number; entry; transitions = Replay.transitions replay; mismatch })
  | Torn _ -> over replay ~torn:true
  | End_of_file -> over replay ~torn:false
  | Wrong { number; why } -> Unreadable { number; why }

let rec search ~most reader partial =
  match Journal.next reader with
  | Line { number; entry } -> (
      match Partial.feed partial entry with
      | Ok partial -> search ~most reader partial
      | Error (Impossible mismatch) -> Impossible { number; entry; lines = Partial.lines partial; mismatch }
      | Error Too_many -> Unknown { number; most })
  | Torn _ | End_of_file -> Possible { lines = Partial.lines partial; over = Partial.is_over partial }
  | Wrong { number; why } -> Unreadable { number; why }

let check ?(world = World.empty) ?(most = most) program ~hash reader =
  match Journal.next reader with
  | Line { entry = Partial { observed }; _ } ->
    (None, search ~most reader (Partial.start ~observed ~most world program))
  | Line { entry = Header header; _ } ->
    let start = Replay.start ~hash program in
    (Some header, go reader (Result.value (Replay.feed start (Header header)) ~default:start))
  | Line { number; _ } | Torn number -> (None, Unreadable { number; why = "the header is missing" })
  | End_of_file -> (None, Unreadable { number = 1; why = "the journal is empty" })
  | Wrong { number; why } -> (None, Unreadable { number; why })

let is_legal = function
  | Run _ | Prefix _ | Possible _ -> true
  | No_run _ | Impossible _ | Unknown _ | Unreadable _ -> false

let pp_ending ppf (e : Request.ending) =
  match e.message with
  | None | Some "" -> Format.pp_print_string ppf e.how
  | Some message -> Format.fprintf ppf "%s: %s" e.how message

let describe (entry : Entry.t) =
  match entry with
  | Header _ | Partial _ -> "a header"
  | Label { label; _ } -> label
  | Vehicle { state; _ } -> "the known state of " ^ state.id
  | Event { event; _ } -> Format.asprintf "%a" Event.pp event
  | Transition { index; step; _ } ->
    let at = Option.fold ~none:"" ~some:(fun at -> ", at " ^ Step.text_of_place at) step.at in
    Printf.sprintf "transition %d%s: %s" index at step.label
  | Note { vehicle; _ } -> "the platform's note on " ^ vehicle
  | Act { act; _ } -> Act.words act
  | Resumed _ -> "a resumption"
  | End { ending; _ } -> Format.asprintf "the end: %a" pp_ending ending

let count n = Phrase.count n "transition"

let pp ppf = function
  | Run { transitions; time; ending } ->
    Format.fprintf ppf "a run, of %s in %s; %a" (count transitions) (Phrase.time time) pp_ending ending
  | Prefix { transitions; time; torn } ->
    Format.fprintf ppf "the beginning of a run, of %s in %s; it breaks off%s" (count transitions) (Phrase.time time)
      (if torn then " in the middle of a line" else "")
  | No_run { number; entry; transitions; mismatch } ->
    Format.fprintf ppf "line %d does not belong to a run: %s@,%a@,before it: %s of a run" number (describe entry)
      Replay.pp_mismatch mismatch (count transitions)
  | Possible { lines; over } ->
    Format.fprintf ppf "a possible run: %s%s" (Phrase.count lines "line")
      (if over then ", to its end" else "")
  | Impossible { number; entry; lines; mismatch } ->
    let show_all ppf = function
      | [] -> Format.pp_print_string ppf "nothing"
      | labels -> Format.pp_print_string ppf (String.concat ", " labels)
    in
    Format.fprintf ppf "line %d does not fit any run: %s@,%s@,possible here: %a@,before it: %s"
      number (describe entry) mismatch.reason show_all mismatch.possible (Phrase.count lines "line")
  | Unknown { number; most } ->
    Format.fprintf ppf
      "not known: between line %d and the one before, more than %d configurations can be hidden; a trace with more \
       labels is easier to judge, and --max-states allows for more"
      number most
  | Unreadable { number; why } -> Format.fprintf ppf "line %d: %s" number why
