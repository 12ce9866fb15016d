open Dolphin_semantics

(* Who comes after all others, in this order, and who does not come. *)
type t = { coming : Core.vehicle list; missing : Core.vehicle list }

(* What the attendance of a pick is chosen from. All in the order of the fleet, and no vehicle among them that stands
   outside of the region wherever it may be seen. *)
type company = {
  wanted : Core.vehicle list;  (* whom the pick would take if they are there *)
  always : Core.vehicle list;  (* those of them that it would take wherever they may be seen *)
  silent : Core.vehicle list;  (* those of them that are lost *)
  unsure : Core.vehicle list;  (* others of them that may be late or missing *)
  is_new : Core.vehicle -> bool;  (* whether to be late is something new, which counts *)
  most_new : int;  (* how many of these there may be *)
}

let company (faults : Faults.t) ~may_be_late ~lost ~late ~bound world (pick : Settings.pick) =
  let is_wanted (s : World.vehicle_state) =
    Settings.accepts { pick.filter with region = None } s && not (List.mem s.id bound)
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
  { wanted; always = ids (List.filter (is_seen_in List.for_all) states); silent; unsure; is_new; most_new }

let unsure company = company.unsure
let without vs = List.filter (fun v -> not (List.mem v vs))
let number_of_new company vs = List.length (List.filter company.is_new vs)

(* The sublists of [n] elements of [vs] of which [news] are new, the first ones first. It never searches in vain. *)
let rec sublists company n news vs : Core.vehicle list Seq.t =
  fun () ->
  let there = number_of_new company vs in
  match vs with
  | _ when news < 0 || news > n || news > there || n - news > List.length vs - there -> Seq.Nil
  | _ when n = 0 -> Seq.return [] ()
  | [] -> Seq.Nil
  | v :: rest ->
    let with_v = sublists company (n - 1) (if company.is_new v then news - 1 else news) rest in
    Seq.append (Seq.map (List.cons v) with_v) (sublists company n news rest) ()

let up_to n : int Seq.t = Seq.unfold (fun i -> if i > n then None else Some (i, i + 1)) 0
let costs company = up_to company.most_new
let subsets company news vs = Seq.flat_map (fun n -> sublists company n news vs) (up_to (List.length vs))

(* The lists of at most [most] different elements of [vs] of which [news] are new; likewise. *)
let rec arrangements company most news vs : Core.vehicle list Seq.t =
  fun () ->
  if news < 0 || news > min most (number_of_new company vs) then Seq.Nil
  else
    let from v =
      let news = if company.is_new v then news - 1 else news in
      Seq.map (List.cons v) (arrangements company (most - 1) news (without [ v ] vs))
    in
    let longer = if most = 0 then Seq.empty else Seq.flat_map from (List.to_seq vs) in
    if news = 0 then Seq.Cons ([], longer) else longer ()

(* [f before v] of each [v] of [vs] that comes after [mark], with those before it. *)
let after mark f vs : 'a Seq.t =
  let rec go before passed vs () =
    match vs with
    | [] -> Seq.Nil
    | v :: rest when String.equal v mark -> go before true rest ()
    | v :: rest ->
      let later = go (v :: before) passed rest in
      if passed then Seq.append (f (List.rev before) v) later () else later ()
  in
  go [] false vs

(* A pick of [n] vehicles binds some that come in the order of the fleet, and then some that are late. In one way only,
   if those that are late are as few as can be: the first of them comes before the last of the others in the fleet. *)
let with_latecomers company n news : (Core.vehicle list * Core.vehicle list) Seq.t =
  let on_time_company = { company with is_new = (fun _ -> false) } in
  let with_coming = function
    | [] -> Seq.empty
    | first :: others as coming ->
      let rest = n - List.length coming - 1 in
      let on_time before v = Seq.map (fun vs -> (vs @ [ v ], coming)) (sublists on_time_company rest 0 before) in
      after first on_time (without others company.wanted)
  in
  Seq.flat_map with_coming (arrangements company (n - 1) news company.unsure)

(* Too few of [n] come if so many are missing: those first whose absence counts for nothing. *)
let too_few company n =
  let least = List.length company.always - (n - 1) in
  let known, unknown = List.partition (fun v -> not (company.is_new v)) company.unsure in
  let may_miss = List.filter (fun v -> List.mem v company.always) (company.silent @ known @ unknown) in
  if least <= 0 || least > List.length may_miss then None else Some (List.filteri (fun i _ -> i < least) may_miss)

(* Who comes to a pick of all vehicles, and in which order; the vehicles that are late are again as few as can be. *)
let of_all company news =
  let with_missing missing =
    let there = without missing company.wanted in
    let matters = function
      | [] -> true
      | first :: others -> after first (fun _ _ -> Seq.return ()) (without others there) () <> Seq.Nil
    in
    let unsure = without missing company.unsure in
    let coming = arrangements company (List.length unsure) (news - number_of_new company missing) unsure in
    Seq.map (fun coming -> { coming; missing }) (Seq.filter matters coming)
  in
  let with_silent silent =
    let absent = Seq.flat_map (fun news -> subsets company news company.unsure) (up_to news) in
    Seq.flat_map (fun unsure -> with_missing (silent @ unsure)) absent
  in
  Seq.flat_map with_silent (subsets company 0 company.silent)
