(** A region of a plane in bands of equal height, one above the other, and the connected parts of the region in each. *)

(** A part of the region that is connected within one band. *)
type part = {
  height : float;  (** of the band's middle *)
  left : float;
  right : float;  (** the part has points as far to the left and to the right as this, and between *)
  gates : (int * float * float) list;  (** the parts of neighbouring bands that it meets, and the ends of each
                                           meeting *)
  upper : int list;  (** those of them that are above *)
  lower : int list;
}

val make : Slabs.t -> most:float -> part array
(** [make slabs ~most] are the parts in as few bands as have a height of at most [most]; one that all bands together
    lack by less than a thousandth of [most] is not added. *)
