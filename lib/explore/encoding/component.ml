(* Components of executing tasks: types only. {!Components} makes them.

   A residual is divided where it has a [Parallel]: its components are those of the [Parallel], or the residual itself.
   A [Parallel] in contexts ({!Residual.context}) makes a nest: the contexts, and the components inside. So a residual
   is a tree of nests with components for leaves, and a component has no [Parallel] that has begun.

   A component belongs to a family: the component that it comes from by local steps, and the others that do. Its
   number is unique within its family only, so that a state needs few bits for it. *)

open Dolphin_semantics
module Residuals = Hashtbl.Make (Residual)

(* The replacement of the component, or of the nest, that a step belongs to. *)
type target =
  | Stays of int  (* the member of its family with this number *)
  | Gone
  | Becomes of { serial : int; children : component tree list; components : component array }
  (* these, side by side, with these leaves; [serial] is unique among such targets *)
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
  renews : bool;  (* whether the contexts may restart their inside endlessly *)
  mutable cut_footprints : (bool * Step_footprints.t) option;  (* by whether tasks are made in the layout *)
}

and component = {
  residual : Residual.t;
  path : path;
  family : family;
  local : int;  (* its number in its family, from 0 *)
  mutable steps : step array;  (* once it is reached *)
  mutable worked_out : step array option;
  mutable alone : target option;  (* the result of the nest if only this component is left inside *)
  makes_tasks : bool;
  mutable footprints : (bool * Step_footprints.t) option;  (* as for paths *)
}

and family = {
  number : int;
  mutable members : component array;
  mutable size : int;
  mutable width : int;  (* in bits, of the numbers of members in the layouts in use; 0 if no layout is in use *)
}

(* The dependence of a step on the shared part. *)
and dependence =
  | Free  (* not at all: always possible, changes nothing *)
  | Guarded of guard  (* it runs code, and has the same target whenever the code goes well *)
  | Dependent  (* in any way *)

(* Memoised by {!Memoised_steps}, by the number of the shared part. *)
and guard = {
  mutable results : int array;  (* see {!Memoised_steps.guarded} *)
  mutable actions : int array;  (* the numbers of actions, if formulas are checked *)
}

(* The ensured deeds of the parts that a step may cut off. *)
and owed = {
  inside : Core.ensured list;  (* of a nest: its children *)
  beside : Core.ensured list list;  (* of a component or nest: the parts beside it, beside the nest around it, ... *)
}

(* The effect of a step in a given shared state. *)
and outcome = {
  possible : bool;
  certain : bool;  (* for every sensor reading, where readings differ *)
  assumed : World.assumption list list;  (* otherwise the readings that it needs: any of these lists *)
  shared : int;  (* after the step *)
  action : int;
  level : int;  (* the replaced part: the step's own place (0), the nest around it (1), ... *)
  target : target;
  rounds : Task_rules.round list;  (* that begin *)
  others : outcome list;  (* its other results, for other sensor readings *)
}

and step = {
  index : int;  (* in [Task_rules.steps], or among the cuts *)
  source : Task_rules.step;  (* of the component, or of the nest *)
  event : Transition.event option;  (* the one that it takes *)
  home : path;  (* its place *)
  kin : family option;  (* of the component *)
  cut_of : path option;  (* the path of the nest that it cuts off *)
  dependence : dependence;
  successor : target;  (* if it goes well *)
  begins : Task_rules.round list;  (* the rounds that begin if it goes well *)
  looks : bool;  (* whether it depends on the vehicles held around it, or on ensured deeds around it *)
  mutable looked : (int * int, outcome) Hashtbl.t option;
  (* memoised by {!Memoised_steps}, by the numbers of the shared part and of the surroundings *)
  mutable free_action : int;  (* the action of a [Free] step, or -1 until it is computed *)
  mutable outcomes : outcome array;  (* memoised by {!Memoised_steps}, by the number of the shared part *)
}

let rec leaves = function
  | Leaf x -> [ x ]
  | Nest (_, children) -> List.concat_map leaves children

let rec map f = function
  | Leaf x -> Leaf (f x)
  | Nest (path, children) -> Nest (path, List.map (map f) children)
