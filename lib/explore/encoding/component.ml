(* What the parts of executing tasks are made of: types only. {!Components} makes them.

   A residual is taken apart where it has a [Parallel]: the parts are the components of it, or the residual itself. A
   [Parallel] that stands in contexts ({!Residual.context}) among others makes a nest: the contexts, and the parts
   inside. So a residual is a tree of nests with parts for leaves, and a part has no [Parallel] that has begun.

   A part belongs to a family: the part that it comes from by local steps, and others that do. Its number is the one
   within its family, so that few bits tell which of the family stands somewhere. *)

open Dolphin_semantics
module Residuals = Hashtbl.Make (Residual)

(* What becomes of what a step belongs to: of a part, or of a nest. *)
type target =
  | Stays of int  (* a part in its family, with this number *)
  | Gone
  | Becomes of { serial : int; children : part tree list; parts : part array }
  (* these, side by side, with these leaves; [serial] tells such targets apart *)
  | Ends of Configuration.ending  (* of the whole run *)

and 'leaf tree = Leaf of 'leaf | Nest of path * 'leaf tree list  (* two of them at least *)

(* The contexts of what stands somewhere: those of the nest, and the path of the nest. The root's has none. *)
and path = {
  id : int;
  contexts : Residual.context list;  (* the innermost first *)
  outer : path option;
  body : Residual.t;  (* some residual that stood there *)
  parts : part Residuals.t;  (* that stand there, by residual *)
  inner : path Residuals.t;  (* those of nests that stand there, by their contexts *)
  mutable cuts : step array option;  (* the steps of the contexts themselves, once they are worked out *)
  mutable cuts_components : Step_footprints.t option;
}

and part = {
  residual : Residual.t;
  path : path;
  family : family;
  local : int;  (* its number in its family, from 0 *)
  mutable steps : step array;  (* once it is reached *)
  mutable worked_out : step array option;
  mutable runs : int;  (* for the use of {!Product}: what it runs, or -1 *)
  mutable alone : target option;  (* of the nest, if this part is all that is left inside *)
  mutable components : Step_footprints.t option;
}

and family = {
  number : int;
  mutable members : part array;
  mutable size : int;
  mutable width : int;  (* in bits, of the numbers of members in the layouts in use; 0 if there is none *)
}

(* How a step depends on what is shared. *)
and dependence =
  | Free  (* not: always possible, changes nothing *)
  | Guarded of guard  (* it runs code, with the same target whenever the code goes well *)
  | By_case  (* in any way *)

and guard = {
  mutable results : int array;  (* see {!Memoised_steps.guarded} *)
  mutable actions : int array;  (* where something observes: the number of what was done *)
}

(* A step as it is when so and so is shared. *)
and case = {
  possible : bool;
  certain : bool;  (* whatever sensors show, where they may show this or that *)
  shared : int;  (* after the step *)
  action : int;  (* the number of what was done *)
  level : int;  (* of what [result] is said: of what the step belongs to (0), the nest around it (1), ... *)
  result : target;
  mutable whole : int;  (* for the use of {!Space}: the number of the configuration that it ends in, or -1 *)
  others : case list;  (* what else it does, if sensors show something else *)
}

and step = {
  index : int;  (* in [Task_rules.steps], or among the cuts *)
  source : Task_rules.step;  (* of the part, or of the nest *)
  event : Transition.event option;  (* the one that it takes *)
  home : path;  (* where that stands *)
  kin : family option;  (* of the part *)
  dependence : dependence;
  target : target;  (* if it goes well *)
  stays : int;  (* [n] if [target] is [Stays n], else -1 *)
  mutable free_action : int;  (* the number of what is done if it is [Free], or -1 as long as nobody asked *)
  mutable cases : case array;  (* by shared number *)
}

let rec leaves = function
  | Leaf x -> [ x ]
  | Nest (_, children) -> List.concat_map leaves children

let rec map f = function
  | Leaf x -> Leaf (f x)
  | Nest (path, children) -> Nest (path, List.map (map f) children)
