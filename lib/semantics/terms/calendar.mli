(** Times of day, and the date at which a run begins. A zone is a fixed offset from UTC: it has no daylight-saving time.

    {[
      open Dolphin_semantics

      let () =
        assert (Calendar.time_of_day "21:30" = Ok 77_400);
        assert (Calendar.zone "+01:00" = Ok 60);
        match Calendar.read ~zone:60 "2026-06-01 21:30" with
        | Ok begins ->
          assert (Fmt.str "%a" Calendar.pp begins = "2026-06-01T21:30:00+01:00");
          assert (Calendar.at begins 9_000 = 0)
        | Error _ -> assert false
    ]} *)

type t = {
  year : int;  (** from 1 to 9999 *)
  month : int;
  day : int;
  second : int;  (** since midnight, below {!day_length} *)
  zone : int;  (** minutes east of UTC *)
}

val day_length : int
(** 86,400: the seconds of a day. *)

val time_of_day : string -> (int, string) result
(** [time_of_day "21:30"] is the seconds from midnight until then. The text has hours from 0 to 23, minutes, and seconds
    if it has three numbers: ["21:30:05"]. *)

val pp_time : Format.formatter -> int -> unit
(** ["21:30:00"]: {!time_of_day} reads it. *)

val zone : string -> (int, string) result
(** ["UTC"], or an offset from it such as ["+01:00"], at most 14 hours. *)

val pp_zone : Format.formatter -> int -> unit
(** ["UTC"], ["+01:00"]: {!val-zone} reads it. *)

val read : zone:int -> string -> (t, string) result
(** [read ~zone "2026-06-01 21:30"] is that moment in that zone. *)

val pp_local : Format.formatter -> t -> unit
(** ["2026-06-01 21:30:00"]: {!read} reads it. *)

val of_unix : zone:int -> float -> t
(** The moment that many seconds after the beginning of 1970 in UTC, in that zone. *)

val pp : Format.formatter -> t -> unit
(** ["2026-06-01T21:30:00+01:00"], as RFC 3339 has it. *)

val of_string : string -> (t, string) result
(** Reads the output of {!pp}. The error goes on after the name of the text: ["not a date such as ..."]. *)

val at : t -> int -> int
(** [at t n] is the time of day [n] seconds after [t], in seconds since midnight, by the offset of [t]. *)
