(** A world to run programs in: its vehicles, the endings of plans on them, the answers of people and the replies of
    a supplier. It is the contents of a fleet file, [*.fleet]; {!section:grammar} has its syntax.

    {[
      open Dolphin_scenario

      let fleet =
        "vehicle 'x8-02', { type 'UAV'; at Location.APDL; joins 30.seconds }\n\
         plan 'survey1', { duration 3.min, 9.min; mayFail }\n\
         answer 'Radius?', 2, 3"

      let () =
        match Scenario.read ~file:"a.fleet" fleet with
        | Ok scenario ->
          assert (Scenario.answer scenario "Radius?" 0 = Some "2");
          assert (Scenario.answer scenario "Radius?" 5 = Some "3");
          assert (Scenario.plan scenario "survey2" = None);
          assert (not (List.hd (Scenario.states scenario)).connected)
        | Error _ -> assert false
    ]} *)

(** {1:types What there is} *)

include module type of struct
  include Entry
end

(** {1:reading Reading and writing} *)

val read :
  ?chart:(string -> (Dolphin_semantics.Chart.t, string) result) -> file:string -> string ->
  (t, Dolphin_syntax.Diagnostic.t list) result
(** [read ~chart ~file source] is the scenario that [source] describes, or what is wrong with it: at least one
    diagnostic and at most {!Dolphin_syntax.Parse.most_faults}, in the order of the text. [file] is only a name.
    [chart] reads the file of a [map] in a fence; by default no file can be read. No text makes it raise. *)

val replies_at : file:string -> string -> (string * Dolphin_syntax.Location.t) list
(** The same for replies, by the names of their calls. *)

val pp : Format.formatter -> t -> unit
(** As a fleet file: [read ~file (Fmt.str "%a" pp s)] is [Ok s]. *)

val equal : t -> t -> bool
(** Wherever fences stand. *)

val default : t
(** The default fleet: three UUVs, [noptilus-1] to [noptilus-3], and the UAV [x8-02], off Leixões. *)

val beside : string -> string
(** [beside program] is the default place of the fleet of the program in file [program]: the same name, ending in
    [.fleet]. *)

(** {1:programs Programs} *)

val within : t -> Dolphin_semantics.Core.program -> Dolphin_semantics.Core.program * Dolphin_plans.Fences.fence list
(** [within s p] is [p] as it runs in [s]: with the fences of [s] too, with the place of [s] for plans if [p] has none,
    and with the date at which runs begin in [s]; and the fences that its known plans are still to be compared with.
    Elaboration compared plans with the fences of [p], except for plans without a place. *)

(** {1:questions Questions} *)

val plan : t -> string -> plan option
(** [plan s name] is the entry of plan [name]. *)

val knows : plan -> vehicle -> bool
(** [knows p v] is whether [v] can run [p]: [p.only] is empty, or has the id or the type of [v] (types without regard
    to case). *)

val answer : t -> string -> int -> string option
(** [answer s prompt n] is the answer to [prompt] when it is asked for the [n]-th time, from 0. The last text answers
    all later ones. [None] if the scenario has nothing for that prompt. *)

val reply : t -> string -> int -> Reply.t option
(** [reply s call n] is the supplier's reply to [call] the [n]-th time, from 0: the first of the possible ones, the
    last time standing for all later ones. [None] if the scenario has nothing for that call. *)

val rounds : t -> string -> Reply.t list list option
(** [rounds s call] is all that it may reply. *)

val posted : input -> int -> Dolphin_semantics.Core.value
(** [posted i n] is the pair posted for the [n]-th time, from 0: the first of the possible ones. *)

val silences : vehicle -> (float * float) list
(** [silences v] is the spans of time, from and until, in which nothing is heard of [v]: before it joins, while its link
    drops, and after it leaves, until [infinity]. They are in order and apart: none empty, none touches the next. *)

val readings : sample list -> vehicle -> Dolphin_geo.Position.t -> time:float -> (string * float) list
(** [readings samples v p ~time] is the measurements of [v] at [p], by quantity, in order: the value of the field
    there; if [v] shows several values, the nearest of them. *)

val fields_still_from : t -> float
(** The time from which no field changes any more. *)

val states : t -> Dolphin_semantics.World.vehicle_state list
(** [states s] is the knowledge about the vehicles at the start; those that join later, or whose link drops right
    then, are not connected. *)

(** {1:grammar The fleet file}

    A fleet is a sequence of entries in the syntax of programs, comments and all, whose values are literals: numbers,
    with or without a unit ([2.km], [9.min], [80.percent]), texts in quotes, places ([Location.APDL]).

    {v
vehicle 'noptilus-1', { type 'UUV'; payload 'DVL', 'Sidescan'; at 41.1850, -8.7060; speed 1.5; battery 100.percent }
vehicle 'x8-02', {
  type 'UAV'
  at Location.APDL
  joins 30.seconds
  drops 60.seconds, 30.seconds
}
plan 'survey1', { duration 3.min, 9.min; mayFail }
answer 'Radius of operation area? (km)', 2
reply 'queue.await', task('survey1'), either(task('survey2'), fails('the queue is closed'))
    v}

    [vehicle ID, { ... }]. Settings in any order, each at most once unless stated otherwise:
    - [type TEXT]: must be there.
    - [payload TEXT, ...]: may stand again. Default: none.
    - [at LATITUDE, LONGITUDE], in degrees, [at LATITUDE, LONGITUDE, HEIGHT], in metres, or [at Location.APDL]. Default:
      off Leixões, beside one another ({!Defaults.position}). South of the equator write [at(-33.9, 18.4)] or
      [at 33.9.south, 18.4.east]: without parentheses the first minus sign would be a subtraction. May stand again: the
      vehicle is at the first place at the start, and is only ever seen at one of them.
    - [speed NUMBER]: m/s. Default: 18 for a UAV, 1.5 for others.
    - [battery SHARE, ...]. Default: [100.percent]. Of several, the first is at the start, and no others are ever shown.
    - [battery unknown]: it never reports its battery, which is full at the start.
    - [drain SHARE]: an hour's work takes this share, an hour's rest a quarter of it. Default: [10.percent].
    - [charge SHARE]: an hour's rest gives this share instead. Default: it does not charge.
    - [charger LATITUDE, LONGITUDE, METRES], [charger PLACE, METRES]: it charges only at rest within that distance; may
      stand again. Default: it charges wherever it rests.
    - [shows QUANTITY, NUMBER, ...]: its measurements, as [reading] shows them; once for each quantity. Of several
      values no others are ever shown: in the simulator the one that is nearest to the field's. Else it shows the
      field's value. Without a field it shows the first. Default: it measures nothing.
    - [joins TIME], [leaves TIME]. Default: there from the start, and for good.
    - [drops FROM, LASTING]: its link drops; may stand again. Default: never.

    [plan NAME], [plan NAME, { ... }]. For plans that are described in the program itself it gives only their ending,
    the vehicles that know them, and whether they charge; their way determines their duration.
    - [duration TIME] or [duration SHORTEST, LONGEST]. Default: any time; the simulator draws from 1 to 3 minutes.
    - [mayFail], [mayFail SHARE]: it fails now and then, or so often ([mayFail] alone: [10.percent]); [fails]: always.
      Default: it succeeds.
    - [at ...]: its place, as for vehicles. Default: the vehicle's place.
    - [only TEXT, ...]: types or ids of the vehicles that know it. Default: all do.
    - [charges SHARE]: an hour of it gives this share, and drains nothing, as at a dock. Default: it drains the battery.

    [answer PROMPT, EXPRESSION, ...]. The answers to the program's question PROMPT: the expressions one after another,
    the last for good. Any expression will do here, for it is only kept as text.

    [reply CALL, REPLY, ...]. The supplier's replies to calls of the program, without a supplier process: the replies
    one after another, the last for good. CALL is as labels name it: ['getSupplier'], or an object and its method or
    property, ['queue.await']. REPLY is as in {!Reply.read}.

    [field QUANTITY, NUMBER, at(...)], [field QUANTITY, NUMBER, at(...), after TIME]. A sample of a quantity, at a place
    and from a time on: {!Sampled_field.value} is the quantity elsewhere. Stands as often as there are samples.

    [fence inside AREA, margin: LENGTH] and its like: as in programs
    ({!Dolphin_semantics.Fence_declarations}), without variables. Every program is kept to it.

    [assume eventually { CONDITION }], [assume eventually { v -> CONDITION }]: an assumption on endless runs, about one
    vehicle, named in quotes, or each. Stands as often as wanted.

    [begins TEXT]: the date at which runs begin, for [timeOfDay()]: ['2026-06-01 21:00']. [zone TEXT]: the zone of times
    of day, ['UTC'] or an offset such as ['+01:00']; by default UTC. Both stand at most once.

    Times without a unit are seconds. *)
