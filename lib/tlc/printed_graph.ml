open Dolphin_lts
module Growing = Int_vector.Growing

(* States are numbered in the order in which they are first mentioned, as a state or as the target of a transition.
   Their texts are long, so their digests are kept. *)
type t = {
  numbers : (Digest.t, int) Hashtbl.t;
  programs : (int, int) Hashtbl.t;  (* by state that had its line *)
  initial : (int, int) Hashtbl.t;  (* by program *)
  labels : (string, int) Hashtbl.t;
  mutable names : string list;  (* of labels, the last first *)
  sources : Growing.t;
  edge_labels : Growing.t;
  targets : Growing.t;
  derivations : (string, int) Hashtbl.t;  (* how many transitions have this one *)
  mutable current : int option;
  mutable transitions : int;
}

type problem =
  | Not_a_line of string
  | No_state_yet
  | Twice of string
  | No_such_state of string
  | Other_program of { from : int; target : int }
  | No_states

let create () =
  { numbers = Hashtbl.create 1000; programs = Hashtbl.create 1000; initial = Hashtbl.create 10;
    labels = Hashtbl.create 100; names = []; sources = Growing.create (); edge_labels = Growing.create ();
    targets = Growing.create ();
    derivations = Hashtbl.create 100; current = None; transitions = 0 }

let mark text = "(" ^ text ^ ")"
let label ~rules text = if rules = "" then text else text ^ " by " ^ rules

(* {1 Reading} *)

let count table key n = Hashtbl.replace table key (n + Option.value (Hashtbl.find_opt table key) ~default:0)

let number table key =
  match Hashtbl.find_opt table key with
  | Some n -> (n, false)
  | None ->
    let n = Hashtbl.length table in
    Hashtbl.add table key n;
    (n, true)

let state_number g text = fst (number g.numbers (Digest.string text))

let label_number g text =
  let n, is_new = number g.labels text in
  if is_new then g.names <- text :: g.names;
  n

let add g source text target =
  Growing.add g.sources source;
  Growing.add g.edge_labels (label_number g text);
  Growing.add g.targets target

let state g text ~program =
  let s = state_number g text in
  if Hashtbl.mem g.programs s then Error (Twice text)
  else begin
    Hashtbl.add g.programs s program;
    if not (Hashtbl.mem g.initial program) then Hashtbl.add g.initial program s;
    g.current <- Some s;
    Ok true
  end

let marked g text =
  match g.current with
  | None -> Error No_state_yet
  | Some s -> add g s (mark text) s; Ok true

let transition g text ~rules target =
  match g.current with
  | None -> Error No_state_yet
  | Some source ->
    add g source (label ~rules text) (state_number g target);
    count g.derivations rules 1;
    g.transitions <- g.transitions + 1;
    Ok true

let fields g line text =
  match String.split_on_char '\t' text with
  | [ "S"; text ] -> state g text ~program:1
  | [ "S"; text; program ] -> (
      match int_of_string_opt program with
      | Some program -> state g text ~program
      | None -> Error (Not_a_line line))
  | "M" :: mark -> marked g (String.concat "\t" mark)
  | "E" :: rest -> (
      match List.rev rest with
      | rules :: target :: (_ :: _ as label) -> transition g (String.concat "\t" (List.rev label)) ~rules target
      | [] | [ _ ] | [ _; _ ] -> Error (Not_a_line line))
  | _ -> Error (Not_a_line line)

let is_ours line =
  let begins prefix = String.length line >= String.length prefix && String.sub line 0 (String.length prefix) = prefix in
  List.exists begins [ {|"S\t|}; {|"M\t|}; {|"E\t|} ]

let line g line =
  if not (is_ours line) then Ok false
  else match Quoted.unescape line with Some text -> fields g line text | None -> Error (Not_a_line line)

(* {1 Graphs} *)

let states g = Hashtbl.length g.programs
let transitions g = g.transitions

let used g =
  let used = Hashtbl.create 60 in
  let add derivation n =
    let rules = List.map String.trim (String.split_on_char ',' derivation) in
    List.iter (fun rule -> count used rule n) (List.sort_uniq String.compare rules)
  in
  Hashtbl.iter add g.derivations;
  fun rule -> Option.value (Hashtbl.find_opt used rule) ~default:0

(* A builder for each program, and for each state its number in its program's graph, where the initial one is first. *)
let numbered g =
  let builders = Hashtbl.create 10 and counts = Hashtbl.create 10 in
  Hashtbl.iter
    (fun program _ ->
       Hashtbl.add builders program (Graph.Builder.create ());
       Hashtbl.add counts program 1)
    g.initial;
  let places = Array.make (Hashtbl.length g.numbers) 0 in
  for s = 0 to Array.length places - 1 do
    match Hashtbl.find_opt g.programs s with
    | Some program when Hashtbl.find g.initial program <> s ->
      let n = Hashtbl.find counts program in
      places.(s) <- n;
      Hashtbl.replace counts program (n + 1)
    | Some _ | None -> ()
  done;
  (builders, counts, places)

exception Problem of problem

let graphs g =
  let builders, counts, places = numbered g in
  let names = Array.of_list (List.rev g.names) in
  let sources = Growing.contents g.sources and targets = Growing.contents g.targets in
  let edge_labels = Growing.contents g.edge_labels in
  let add i =
    let s = Int_vector.get sources i and t = Int_vector.get targets i in
    let name = names.(Int_vector.get edge_labels i) in
    match Hashtbl.find_opt g.programs s, Hashtbl.find_opt g.programs t with
    | Some from, Some target when from <> target -> raise_notrace (Problem (Other_program { from; target }))
    | Some program, Some _ -> Graph.Builder.add (Hashtbl.find builders program) places.(s) name places.(t)
    | _, None | None, _ -> raise_notrace (Problem (No_such_state name))
  in
  let all () =
    if Hashtbl.length g.programs = 0 then raise_notrace (Problem No_states);
    for i = 0 to Int_vector.length sources - 1 do
      add i
    done;
    Hashtbl.fold
      (fun program b graphs -> (program, Graph.Builder.finish ~states:(Hashtbl.find counts program) b) :: graphs)
      builders []
  in
  match all () with
  | graphs -> Ok (List.sort (fun (a, _) (b, _) -> Int.compare a b) graphs)
  | exception Problem problem -> Error problem

let pp_problem ppf = function
  | Not_a_line line -> Fmt.pf ppf "this line has no state and no transition: %s" line
  | No_state_yet -> Fmt.string ppf "a transition or a mark comes before any state"
  | Twice state -> Fmt.pf ppf "a state comes twice: %s" state
  | No_such_state label -> Fmt.pf ppf "a transition %s leads to a state that does not come" label
  | Other_program { from; target } -> Fmt.pf ppf "a transition leads from program %d to program %d" from target
  | No_states -> Fmt.string ppf "no state was printed"
