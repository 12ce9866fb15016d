(** Journals, checked by the semantics: a journal is that of a run if each of its transitions is the one that
    {!Dolphin_semantics.Transition} gives for the configuration before it, the known vehicles, and the event before
    it. Of the lines only the configuration that they lead to is kept.

    {[
      open Dolphin_semantics
      open Dolphin_runtime
      open Dolphin_platform_sim
      open Dolphin_trace

      let program =
        let text = "v = pick { count 1 }\nexecute v: task('survey1')" in
        let ast = Result.get_ok (Dolphin_syntax.Parse.program ~file:"a.dol" text) in
        fst (Result.get_ok (Elaborate.program ~source_name:"a.dol" ast))

      let fleet = Simulator.Virtual.create ~seed:1 Dolphin_scenario.Scenario.default
      let console = Console.scripted ~answers:[] ()
      let interruption = fst (Lwt.wait ())

      let header =
        { Header.program = Header.source ~path:"a.dol" ""; fleet = None; platform = "sim"; order = By_hearing; seed = 1;
          speed = None; started = "2026-03-01T12:00:00Z"; run = None; fences = []; place = None;
          begins = None }

      (* The lines of a run, in order. *)
      let journal =
        let lines = ref [] in
        let recorder = Recorder.make program header (fun entry -> lines := entry :: !lines) in
        let observer =
          { Observer.nobody with
            transition = (fun ~time ~cause t -> Recorder.transition recorder ~time ~cause t);
            news = Recorder.news recorder }
        in
        ignore (Lwt_main.run (Driver.run (module Simulator.Virtual) fleet ~observer ~console ~interruption program));
        List.rev !lines

      let check lines =
        let feed checked entry = Result.bind checked (fun replay -> Replay.feed replay entry) in
        List.fold_left feed (Ok (Replay.start ~hash:header.program.hash program)) lines

      let is_start = function Entry.Transition { step; _ } -> step.label = "start(noptilus-1, survey1)" | _ -> false

      let () =
        assert (Result.is_ok (check journal));
        match check (List.filter (fun entry -> not (is_start entry)) journal) with
        | Error mismatch -> assert (mismatch.enabled = [ "start(noptilus-1, survey1)" ])
        | Ok _ -> assert false
    ]} *)

open Dolphin_semantics

type t

val start : hash:string -> Core.program -> t
(** [start ~hash program] is before the first line; [hash] is that of the program's text, as in {!Header.source}. If
    a journal's header, or the line of its latest resumption, has another hash, the places of transitions are not
    compared: in a program that was changed they are elsewhere. If [program] has no place for its plans, they have that
    of the header. *)

(** Why no run has this line. *)
type mismatch = {
  reason : string;  (** a sentence without a full stop *)
  false_guards : (Dolphin_syntax.Location.t * string) list;
  (** the conditions that the task waits for and that are false, by place and kind *)
  enabled : string list;  (** labels of the steps that the program could take by itself; the first ones of a long
                              list *)
  awaited : string list;  (** the events that it waited for *)
}

val feed : t -> Entry.t -> (t, mismatch) result
(** [feed r line] is [r] after [line]. *)

val latest : t -> (Transition.event option * Transition.t) option
(** The transition of the latest line, with its cause; [None] if that line was not a transition. *)

val event : t -> Transition.event option
(** The event of the latest line, if the transition that it causes is still to come. *)

val configuration : t -> Configuration.t
(** After the latest transition. *)

val world : t -> World.t
(** The known vehicles. *)

val transitions : t -> int
(** How many there were. *)

val time : t -> float
(** Of the latest line. *)

val was_stuck : t -> bool
(** The program was interrupted because it was stuck. *)

(** The place where a run was stuck: in tasks, or in a loop of the script. *)
type stuck = In of Residual.t | At of Core.site

val stuck : t -> stuck option
(** Where the run was stuck, if it was interrupted for that. *)

val ending : t -> Request.ending option
(** How the run ended, if its last line was there. *)

val pp_mismatch : Format.formatter -> mismatch -> unit
(** The reason, and further lines, for a vertical box. *)
