(* Components of executing tasks: types only. {!Components} makes them.

   A residual is divided where it has a [Parallel]: its components are those of the [Parallel], or the residual itself.
   A [Parallel] in contexts ({!Residual.context}) makes a nest: the contexts, and the components inside. So a residual
   is a tree of nests with components for leaves, and a component has no [Parallel] that has begun.

   A component belongs to a family: the component that it comes from by local steps, and the others that do. It is
   numbered within its family, so that a state needs few bits to say which member of the family it has. *)

open Dolphin_semantics
module Residuals = Hashtbl.Make (Residual)

(* What takes the place of the component, or of the nest, that a step belongs to. *)
type target =
  | Stays of int  (* the member of its family with this number *)
  | Gone
  | Becomes of { serial : int; children : component tree list; components : component array }
  (* these, side by side, with these leaves; [serial] tells such targets apart *)
  | Ends of int  (* the whole run ends, in the configuration with this number ({!Encoding}) *)

and 'leaf tree = Leaf of 'leaf | Nest of path * 'leaf tree list  (* two of them at least *)

(* The contexts around components: those of their nest, and the path of the nest. The root's path has none. *)
and path = {
  id : int;
  contexts : Residual.context list;  (* the innermost first *)
  outer : path option;
  body : Residual.t;  (* some residual that stood there *)
  components : component Residuals.t;  (* that stand there, by residual *)
  inner : path Residuals.t;  (* those of nests that stand there, by their contexts *)
  mutable cuts : step array option;  (* the steps of the contexts themselves, once they are worked out *)
  makes : bool;  (* whether tasks are made in the contexts *)
  renews : bool;  (* whether the contexts may begin what is inside anew, for ever *)
  mutable cut_footprints : (bool * Step_footprints.t) option;  (* by whether tasks are made in the layout *)
}

and component = {
  residual : Residual.t;
  path : path;
  family : family;
  local : int;  (* its number in its family, from 0 *)
  mutable steps : step array;  (* once it is reached *)
  mutable worked_out : step array option;
  mutable alone : target option;  (* what becomes of the nest if this component is all that is left inside *)
  makes_tasks : bool;
  mutable footprints : (bool * Step_footprints.t) option;  (* as for paths *)
}

and family = {
  number : int;
  mutable members : component array;
  mutable size : int;
  mutable width : int;  (* in bits, of the numbers of members in the layouts in use; 0 if there is none *)
}

(* How a step depends on what is shared. *)
and dependence =
  | Free  (* not at all: always possible, changes nothing *)
  | Guarded of guard  (* it runs code, and has the same target whenever the code goes well *)
  | Dependent  (* in any way *)

(* Memoised by {!Memoised_steps}, by the number of what is shared. *)
and guard = {
  mutable results : int array;  (* see {!Memoised_steps.guarded} *)
  mutable actions : int array;  (* the numbers of actions, if formulas are checked *)
}

(* What a step does in a given shared state. *)
and outcome = {
  possible : bool;
  certain : bool;  (* whatever sensors show, where they may show this or that *)
  assumed : World.assumption list list;  (* otherwise the readings that it needs: any of these lists *)
  shared : int;  (* after the step *)
  action : int;
  level : int;  (* whose place [target] takes: that of what the step belongs to (0), of the nest around it (1), ... *)
  target : target;
  rounds : Task_rules.round list;  (* that begin *)
  others : outcome list;  (* what else it does, if sensors show something else *)
}

and step = {
  index : int;  (* in [Task_rules.steps], or among the cuts *)
  source : Task_rules.step;  (* of the component, or of the nest *)
  event : Transition.event option;  (* the one that it takes *)
  home : path;  (* where that stands *)
  kin : family option;  (* of the component *)
  dependence : dependence;
  successor : target;  (* if it goes well *)
  begins : Task_rules.round list;  (* the rounds that begin if it goes well *)
  looks : bool;  (* whether it depends on what vehicles are held around *)
  mutable looked : (int * Core.vehicle list * Residual.timer list * Core.vehicle list list, outcome) Hashtbl.t option;
  (* memoised by {!Memoised_steps}, by the number of what is shared and by what is around, if it [looks] *)
  mutable free_action : int;  (* the action of a [Free] step, or -1 while nobody has asked *)
  mutable outcomes : outcome array;  (* memoised by {!Memoised_steps}, by the number of what is shared *)
}

let rec leaves = function
  | Leaf x -> [ x ]
  | Nest (_, children) -> List.concat_map leaves children

let rec map f = function
  | Leaf x -> Leaf (f x)
  | Nest (path, children) -> Nest (path, List.map (map f) children)
