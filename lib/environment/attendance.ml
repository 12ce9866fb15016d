open Dolphin_semantics

(* The vehicles that come after all others, in this order, and the missing ones. *)
type t = { coming : Core.vehicle list; missing : Core.vehicle list }

(* The possible attendances of a pick. All in the order of the fleet, and no vehicle among them that stands outside
   of the region wherever it may be seen. *)
type company = {
  wanted : Core.vehicle list;  (* the vehicles that the pick would take if they are there *)
  always : Core.vehicle list;  (* those of them that it would take wherever they may be seen *)
  silent : Core.vehicle list;  (* those of them that are lost *)
  unsure : Core.vehicle list;  (* others of them that may be late or missing *)
  is_new : Core.vehicle -> bool;  (* whether to be late is something new, which counts *)
  most_new : int;  (* how many of these there may be *)
  alike : Core.vehicle -> Core.vehicle option;  (* the same of all that may be exchanged with each other *)
  only : Core.vehicle list option;  (* the list of bound vehicles that is looked for *)
}

let company ?(alike = fun _ -> None) ?only (faults : Faults.t) ~may_be_late ~lost ~late ~bound world
    (pick : Settings.pick) =
  let bound = Vehicle_set.of_list bound in
  let is_wanted (s : World.vehicle_state) =
    Settings.accepts { pick.filter with region = None } s && not (Vehicle_set.mem s.id bound)
  in
  let is_seen_in holds (s : World.vehicle_state) =
    match pick.filter.region with
    | None -> true
    | Some area -> holds (Dolphin_geo.Area.contains area) (World.places_of world s)
  in
  let states = List.filter is_wanted (World.vehicles world) in
  let ids states = List.map (fun (s : World.vehicle_state) -> s.id) states in
  let wanted = ids (List.filter (is_seen_in List.exists) states) in
  let may_be_late v = Faults.is_possible faults.join && may_be_late v in
  let silent, others = List.partition (fun v -> List.mem v lost) wanted in
  let unsure = List.filter may_be_late others in
  let is_new v = List.mem v unsure && not (List.mem v late) in
  let new_ones = List.length (List.filter is_new unsure) in
  let most_new =
    match faults.join with
    | Never -> 0
    | At_most n -> min new_ones (max 0 (n - List.length late))
    | Any_number -> new_ones
  in
  { wanted; always = ids (List.filter (is_seen_in List.for_all) states); silent; unsure; is_new; most_new;
    alike; only }

let unsure company = company.unsure

let first_always company n =
  if List.compare_length_with company.always n < 0 then None else Some (List.filteri (fun i _ -> i < n) company.always)

let without vs = List.filter (fun v -> not (List.mem v vs))
let number_of_new company vs = List.length (List.filter company.is_new vs)

let up_to n : int Seq.t = Seq.unfold (fun i -> if i > n then None else Some (i, i + 1)) 0
let costs company = up_to company.most_new
(* {1 Lists of vehicles}

   The bound vehicles are those that come in the order of the fleet, and then the late ones. In one way only, if
   those that are late are as few as can be: the first of them comes before the last of the others in the fleet. So a
   list is made vehicle by vehicle, and from the first one on that comes before the one ahead of it in the fleet, all
   are late. Of vehicles that are alike, the first that is left is next: the list that has others in its place is an
   image of it. *)

type list_of_bound = {
  on_time : Core.vehicle list;  (* latest first, as are [coming] *)
  coming : Core.vehicle list;
  left : Core.vehicle list;  (* in the order of the fleet *)
  passed : Core.vehicle list;  (* those of [left] that come before the last that is on time *)
}

let nobody company = { on_time = []; coming = []; left = company.wanted; passed = [] }
let length l = List.length l.on_time + List.length l.coming

(* Those of [vs] of which none that is alike comes before. *)
let first_of_alike company vs =
  let add (found, classes) v =
    match company.alike v with
    | None -> (v :: found, classes)
    | Some c when List.mem c classes -> (found, classes)
    | Some c -> (v :: found, c :: classes)
  in
  List.rev (fst (List.fold_left add ([], []) vs))

let is_unsure company v = List.mem v company.unsure

let rec until v = function u :: rest when not (String.equal u v) -> u :: until v rest | _ -> []

(* Those that may be next: where a list is looked for, the next one of it, or one that may be seen outside. *)
let next company l =
  match company.only with
  | None -> first_of_alike company l.left
  | Some vs ->
    let is_bound v = List.mem v vs in
    let number = List.length (List.filter is_bound (l.on_time @ l.coming)) in
    let is_next v =
      if is_bound v then List.nth_opt vs number = Some v else not (List.mem v company.always) in
    List.filter is_next l.left

(* [l] with one more vehicle, in each way. *)
let longer company l =
  let add v =
    let is_late = l.coming <> [] || List.mem v l.passed in
    let left = without [ v ] l.left in
    if not is_late then Some { l with on_time = v :: l.on_time; left; passed = until v l.left }
    else if is_unsure company v then Some { l with coming = v :: l.coming; left; passed = without [ v ] l.passed }
    else None
  in
  List.filter_map add (next company l)

(* The lists of at most [most] vehicles, each after its beginnings; none that begins with one of which [is_hopeless]. *)
let rec lists company ~is_hopeless most l : list_of_bound Seq.t =
  fun () ->
  if is_hopeless l then Seq.Nil
  else
    let longer_ones () =
      if most = 0 then Seq.Nil
      else Seq.flat_map (lists company ~is_hopeless (most - 1)) (List.to_seq (longer company l)) ()
    in
    Seq.Cons (l, longer_ones)

let with_latecomers company n news : (Core.vehicle list * Core.vehicle list) Seq.t =
  let is_hopeless l =
    let found = number_of_new company l.coming and missing = n - length l in
    let may_be_late = List.filter (is_unsure company) l.left in
    (* The number of passed vehicles that need not be bound. *)
    let spare = List.length l.left - missing in
    spare < 0
    || found > news
    || found + number_of_new company l.passed - spare > news
    || found + min missing (number_of_new company may_be_late) < news
    || (l.coming = [] && (missing = 0 || may_be_late = []))
    || (l.coming <> [] && List.length may_be_late < missing)
  in
  let whole l = if length l = n then Some (List.rev l.on_time, List.rev l.coming) else None in
  let is_right (_, coming) = number_of_new company coming = news in
  Seq.filter is_right (Seq.filter_map whole (lists company ~is_hopeless n (nobody company)))

(* The lists of [n] of [vs], in their order; of those that differ in alike vehicles, the one with the first of these. *)
let rec first_sublists company n vs () =
  match vs with
  | _ when n = 0 -> Seq.Cons ([], Seq.empty)
  | _ when List.compare_length_with vs n < 0 -> Seq.Nil
  | [] -> Seq.Nil
  | v :: rest ->
    let is_other u = company.alike v = None || company.alike u <> company.alike v in
    let taken = Seq.map (List.cons v) (first_sublists company (n - 1) rest) in
    Seq.append taken (first_sublists company n (List.filter is_other rest)) ()

(* Too few of [n] come if this number are missing: those first whose absence counts for nothing. *)
let too_few company n =
  let least = List.length company.always - (n - 1) in
  let is_always v = List.mem v company.always in
  let known, unknown = List.partition (fun v -> not (company.is_new v)) (List.filter is_always company.unsure) in
  let for_nothing = List.filter is_always company.silent @ known in
  let more = least - List.length for_nothing in
  if least <= 0 || more > List.length unknown then Seq.empty
  else
    let for_nothing = List.filteri (fun i _ -> i < least) for_nothing in
    Seq.map (fun counted -> for_nothing @ counted) (first_sublists company (max 0 more) unknown)

(* The vehicles that come to a pick of all vehicles, in their order. Those that are left are missing, and may be. *)
let of_all company news =
  let may_miss v = is_unsure company v || List.mem v company.silent in
  (* Those that are passed will be late or missing, and once one is late, so will all that are left. *)
  let is_hopeless l =
    let absent = if l.coming = [] then l.passed else l.left in
    let counted = number_of_new company l.coming + number_of_new company absent in
    counted > news || (l.coming <> [] && counted < news) || not (List.for_all may_miss absent)
  in
  let attendance l =
    let silent, absent = List.partition (fun v -> List.mem v company.silent) l.left in
    let missing = silent @ absent in
    let counted = number_of_new company l.coming + number_of_new company missing in
    if counted = news && List.for_all may_miss l.left then Some { coming = List.rev l.coming; missing } else None
  in
  let most = List.length company.wanted in
  if company.unsure = [] && company.silent = [] then
    if news = 0 then Seq.return { coming = []; missing = [] } else Seq.empty
  else Seq.filter_map attendance (lists company ~is_hopeless most (nobody company))
