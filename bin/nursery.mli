(** Long programs and runs of many vehicles make much that lives long: a roomy nursery (minor heap) saves a fifth of the
    time. What is soon over is faster without: it would spend a tenth of its time on pages that are new. *)

val make_room : unit -> unit
(** A search that may take all memory does so before: there may be none left for it later. *)

val make_room_later : unit -> unit
(** Makes room once the usual nursery has been filled fifty times. *)
