(** The knowledge of a vehicle about the other systems.

    A vehicle sends its messages to every system that has announced an address and is in contact. Contact is a packet
    from that system to the vehicle's data port; it lasts {!patience}. The vehicle looks for new contacts every
    [period] seconds only, so that it begins to send some time after the first packet came. *)

type t

val empty : period:float -> phase:float -> t
(** [empty ~period ~phase] has no system in it. It looks at times [phase], [phase +. period], and so on; with a [period]
    of 0 contact is seen at once. *)

val patience : float
(** 30 s. *)

val announced : id:int -> name:string -> Address.t list -> t -> t
(** [announced ~id ~name addresses p]. The addresses that a system announces first are the ones that count, for good:
    if it announces others later it gets nothing. Beyond {!most} systems, further ones are left out. *)

val most : int
(** 64. *)

val heard : id:int -> host:string -> at:float -> t -> t
(** [heard ~id ~host ~at p] after a packet of system [id] came from [host] to the data port. It does not count if [id]
    has not announced an address at [host]. *)

val due : t -> float option
(** When {!look} finds a contact that is new. *)

val look : at:float -> t -> (int list * t) option
(** [look ~at p] is the systems that are from now on listened to, if it is time to look. *)

val listeners : at:float -> t -> Address.t list
(** The destinations: one address for each system in contact, in order of their numbers. *)

val name : int -> t -> string
(** [name id p] is the name that system [id] announced; ["unknown"] if it never did. *)
