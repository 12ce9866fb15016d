(** Values of programs as JSON, for the host process.

    [null], booleans, numbers, strings and lists are what they look like; an object is a map, in order. Values that
    JSON lacks are objects with keys of their own:
    {v
{"object": "queue"}                                     an object of the host, by its name there
{"task": "survey1"}                                     the platform task (the plan) of this name
{"vehicles": ["x8-02", "noptilus-1"]}                   a vehicle set
{"latitude": 41.18, "longitude": -8.70, "height": 10}   a position; without height: 0
{"centre": {"latitude": ...}, "radius": 200}            an area; metres
{"map": {"object": "a plain key"}}                      a map, whatever its keys are
    v}

    {[
      open Dolphin_json
      open Dolphin_semantics

      let survey = Host_value.of_json ~site:Fault.unknown_site (`Assoc [ ("task", `String "survey1") ])

      let () =
        assert (Host_value.to_json (String "x8-02") = Ok (`String "x8-02"));
        assert (Host_value.to_json Wildcard |> Result.is_error);
        match survey with
        | Ok (Task _) -> ()
        | _ -> assert false
    ]} *)

open Dolphin_semantics

val to_json : Core.value -> (Yojson.Safe.t, string) result
(** [to_json x] is [x] in JSON. A range goes as a list, a symbol as a string. Or why it cannot go: closures, inline
    plans, composed tasks and [_] stay in the program, and so do numbers that are not finite. *)

val of_json : site:Core.site -> Yojson.Safe.t -> (Core.value, string) result
(** [of_json ~site json] is the value that [json] stands for; its tasks come from [site]. A whole number is an integer
    if it is written as one and fits. *)

val data_of_json : Yojson.Safe.t -> (Core.value, string) result
(** [data_of_json json] is a value that the outside may post: without tasks and objects of the host. *)

val is_data : Core.value -> bool
(** Whether it has neither tasks nor objects of the host. *)

val parse : ?deepest:int -> string -> (Yojson.Safe.t, string) result
(** [parse text] is the JSON value that [text] is, or what is wrong: texts are UTF-8 and numbers finite. Nesting is
    bounded, by [deepest] (200 by default), so that no text exhausts the stack. *)
