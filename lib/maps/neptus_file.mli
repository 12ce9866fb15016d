(** Maps of Neptus, the [*.nmap] in its missions. *)

val read : string -> Drawn.t list
(** Marks and transponders; paths, of which those that Neptus draws as a shape are areas, unless they cross
    themselves, as drawn by hand; boxes and cylinders, mine danger areas; line segments and Q-routes. Images and
    models are left out. A name is the element's identifier, as Neptus shows it. Raises {!Drawn.Wrong}. *)
