(** How often something happens, estimated by how often it happened in a sample.

    {[
      open Dolphin_statistics

      (* None of 100 runs failed: with a confidence of 95 %, fewer than 4 % do. *)
      let () =
        let { Share.least; most } = Share.interval ~level:0.95 ~hits:0 100 in
        assert (least = 0. && most > 0.03 && most < 0.04)
    ]} *)

type interval = { least : float; most : float }  (** [0 <= least <= most <= 1] *)

val interval : level:float -> hits:int -> int -> interval
(** [interval ~level ~hits n] is the interval of Clopper and Pearson: if [n] independent samples hit with the same
    probability [p], then intervals made like this contain [p] with a probability of [level] or more, whatever [p] is.
    [0 <= hits <= n], [0 < level < 1]; of no samples it is all of [0, 1]. *)

val half_width : interval -> float
(** Half of the difference between [most] and [least]. *)

(** {1:looks Looking more than once}

    A procedure that looks at a growing sample again and again, and stops as soon as the interval is narrow, stops
    too often by luck. So each look has a level of its own: the [j]-th may be wrong with a probability of [(1 -
    level) / (j (j + 1))]. All of these together are [1 - level] at most, so the interval at any stopping time is
    right with a probability of [level] or more. *)

val look : int -> int
(** [look j] is the size of the sample at the [j]-th look, from 1 on: 100, and then each time a quarter more. *)

val level_of_look : level:float -> int -> float
(** [level_of_look ~level j] is [1 - (1 - level) / (j (j + 1))]. *)
