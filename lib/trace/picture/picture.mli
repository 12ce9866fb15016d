(** A run as a picture: the tasks of vehicles over time, their ways, their batteries. *)

val svg : Summary.t -> string
(** A document of its own, without references to anything outside. It follows the viewer's choice of light or dark, and
    prints dark on white. *)

val html : Summary.t -> string
(** The same in a page, with the tasks as a table below. The vehicle under the pointer stands out in all charts, and a
    slider shows where all are at any time. *)

(** {1:other Other pictures} *)

val sheet : alone:bool -> title:string -> width:float -> height:float -> Svg.t list -> Svg.t
(** [sheet ~alone ~title ~width ~height parts] is a document of this size in the usual {!Style}; not [alone], it is part
    of a page, and as wide as that. *)

val to_file : Svg.t -> string
(** The text of a file with a [sheet]. *)

val page : ?below:Svg.t list -> title:string -> Svg.t -> string list -> string list list -> string
(** [page ~below ~title picture heads rows] is a page with [picture], and below it [below] and the table of [rows]. *)
