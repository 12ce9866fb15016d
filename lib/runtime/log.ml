open Dolphin_semantics

let source = Logs.Src.create "dolphin.runtime" ~doc:"Events, transitions and their effects"

module Log = (val Logs.src_log source : Logs.LOG)

let pp_event ppf : Transition.event -> unit = function
  | Vehicle_done v -> Fmt.pf ppf "%s ends its task" v
  | Vehicle_failed (v, why) -> Fmt.pf ppf "%s fails: %s" v why
  | Timer_expired timer -> Fmt.pf ppf "timer %d expires" timer
  | Confirmed (question, Ok yes) -> Fmt.pf ppf "question %d: %s" question (if yes then "yes" else "no")
  | Confirmed (question, Error why) -> Fmt.pf ppf "question %d: no answer: %s" question why
  | Recruited (number, v) -> Fmt.pf ppf "%s comes to recruit %d" v number
  | Answered { text; _ } -> Fmt.pf ppf "answer %S" text
  | Nobody_answers why -> Fmt.pf ppf "no answer: %s" why
  | Replied x -> Fmt.pf ppf "the host replies %a" Value.pp x
  | Host_failed why -> Fmt.pf ppf "the host fails: %s" why
  | Input (k, x) -> Fmt.pf ppf "input %s: %a" k Value.pp x
  | Interruption -> Fmt.string ppf "interruption"

let transition ~time ~cause (t : Transition.t) =
  Log.debug (fun m ->
      let on ppf event = Fmt.pf ppf " on: %a" pp_event event in
      m "%.3f %a%a" time Label.pp t.label Fmt.(option on) cause);
  List.iter (fun asked -> Log.debug (fun m -> m "%.3f asks: %a" time Effect.pp asked)) t.effects

let not_awaited ~time event = Log.debug (fun m -> m "%.3f not awaited: %a" time pp_event event)

let vehicle ~time (v : World.vehicle_state) =
  Log.debug (fun m ->
      m "%.3f %s %s: battery %s, at %.5f, %.5f" time v.id
        (if v.connected then Option.value v.unready ~default:"is ready" else "is not connected")
        (Option.fold v.battery ~none:"unknown" ~some:(Printf.sprintf "%.2f"))
        v.position.latitude v.position.longitude)
