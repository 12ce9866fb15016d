(** Pictures as trees of elements. *)

type t

val element : string -> (string * string) list -> t list -> t
(** [element name attributes children]. *)

val raw : string -> t
(** Markup as it is, of our own making: a style sheet. *)

val group : ?name:string -> t list -> t
(** [group ~name ts] is [ts] together, of class [name]. *)

val chart : left:float -> right:float -> top:float -> bottom:float -> t list -> t
(** [chart ~left ~right ~top ~bottom ts] is [ts] together, which stand over time from [left] to [right]. A page finds
    them by its attributes. *)

val number : float -> string
(** In picture units, to a tenth: ["12.5"], ["12"]. *)

val rect : ?name:string -> ?round:float -> ?tip:string -> x:float -> y:float -> width:float -> height:float -> unit -> t
(** [rect ~name ~tip ...] is a rectangle of class [name]; [tip] is shown where the pointer rests on it. *)

val line : ?name:string -> float * float -> float * float -> t
(** From one point to the other. *)

val polyline : ?name:string -> ?tip:string -> (float * float) list -> t
(** Through the points. *)

val circle : ?name:string -> ?tip:string -> float * float -> float -> t
(** [circle centre radius]. *)

val path : ?name:string -> ?tip:string -> string -> t
(** A path, by its commands. *)

val text_only : string -> t
(** Text for an element of another kind. *)

(** The point of a text that stands at its place. *)
type anchor = Start | Middle | End

val text : ?name:string -> ?anchor:anchor -> ?tip:string -> float * float -> string -> t
(** One line of text, on its base line. Control characters become blanks. *)

val width : ?size:float -> string -> float
(** [width ~size text] is about how wide [text] is in a sans-serif of [size], by default 11. *)

val fit : ?size:float -> float -> string -> string
(** [fit ~size width text] is [text], cut to [width] with an ellipsis if it is wider; [""] if nothing of it fits. *)

val to_string : t -> string
(** The text of the element and its children. *)
