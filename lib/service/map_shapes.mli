(** Positions and areas of a program as its text describes them, with the places of their numbers: an editor shows them
    on a map and changes the text where one is moved. *)

open Dolphin_syntax

(** As {!Occurrences.span}. *)
type span = Occurrences.span = { start : int; stop : int }

type number = { span : span; negative : bool  (** whether a number below 0 may stand there *) }
(** A number as it is written, a sign and parentheses around it included. *)

(** A position. [coordinates] is the places of its latitude and its longitude if the text has both as plain numbers of
    degrees; any other position, of a variable, a text or an expression, is fixed. *)
type point = { at : Dolphin_geo.Position.t; coordinates : (number * number) option }

(** The kinds of shapes. *)
type form =
  | Spot of point
  | Way of point list  (** a list of positions *)
  | Plan of point list  (** the places of an [imcPlan], in the order of the text *)
  | Rings of point list list  (** the corners of a polygon, then those of its holes *)
  | Round of { centre : point; radius : float; metres : number option }
  (** [metres] is the place of the radius if it is a plain number, or one with the unit [m] *)
  | Computed of Dolphin_geo.Area.t  (** an area that is computed: fixed *)

type t = { name : string; form : form; span : span }
(** [name] is the variable that the shape is assigned to, or of which it is a part; the name of a plan; or the word that
    begins it. *)

val most_points : int
(** 2,000: shapes beyond that many points are left out. *)

val of_program :
  source:string ->
  chart:(string -> (Dolphin_semantics.Chart.t, string) result) ->
  place:Dolphin_geo.Position.t option ->
  Ast.program ->
  t list
(** [of_program ~source ~chart ~place ast] is the shapes of [ast], which [source] spells, in the order of the text:
    those with at least one point in plain numbers, and the positions and areas of variables whose values are known
    before the program runs. [chart] and [place] are as of {!Dolphin_semantics.Elaborate.known_plans}. *)
