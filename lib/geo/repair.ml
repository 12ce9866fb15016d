type change = Spikes | Repetitions | Crossings | Lost_holes | Holes

let ( let* ) = Result.bind

let pp ppf change =
  Fmt.string ppf
    (match change with
     | Spikes -> "spikes are cut off"
     | Repetitions -> "corners that repeat the one before are left out"
     | Crossings -> "the rim touches or crosses itself slightly, and is cut there"
     | Lost_holes -> "holes without extent are left out"
     | Holes -> "holes that meet or reach out of the polygon are united and cut off")

(* {1 Corners on the grid} *)

let near (ax, ay) (bx, by) = abs (ax - bx) <= 1 && abs (ay - by) <= 1

(* Whether [c] is within some millimetres of the line from [a] to [b], between the two. *)
let is_on (ax, ay) (bx, by) (cx, cy) =
  let ux = float_of_int (bx - ax) and uy = float_of_int (by - ay) in
  let vx = float_of_int (cx - ax) and vy = float_of_int (cy - ay) in
  let square = (ux *. ux) +. (uy *. uy) in
  let along = (ux *. vx) +. (uy *. vy) in
  square > 0. && along >= 0. && along <= square && Float.abs ((ux *. vy) -. (uy *. vx)) <= 2. *. sqrt square

(* At [b] the way turns back on itself. *)
let is_spike a b c = near a c || is_on b a c || is_on b c a

(* [found] has the ring's corners so far, latest first. A corner may be a spike only after those behind it are gone. *)
let rec add changes found c =
  match found with
  | b :: _ when near b c -> changes := Repetitions :: !changes; found
  | b :: (a :: _ as before) when is_spike a b c -> changes := Spikes :: !changes; add changes before c
  | found -> c :: found

(* The closing point of the ring. *)
let rec closed changes ring =
  match ring, List.rev ring with
  | first :: second :: _ :: _, last :: beside :: _ ->
    if near first last then begin changes := Repetitions :: !changes; closed changes (List.tl ring) end
    else if is_spike last first second then begin changes := Spikes :: !changes; closed changes (List.tl ring) end
    else if is_spike beside last first then begin
      changes := Spikes :: !changes;
      closed changes (List.rev (List.tl (List.rev ring)))
    end
    else ring
  | _, _ -> []

let cleaned changes ring = closed changes (List.rev (List.fold_left (add changes) [] ring))

let left_turning ring =
  if Arrangement.doubled_area ring > 0 then ring
  else Array.init (Array.length ring) (fun i -> ring.(Array.length ring - 1 - i))

(* {1 Regions} *)

let area rings = List.fold_left (fun sum ring -> sum +. float_of_int (Arrangement.doubled_area ring)) 0. rings

(* Whether a polygon of the size [whole] with these rings may be meant if its size is another by [change]. *)
let is_slight change rings ~whole =
  let length = List.fold_left (fun sum ring -> sum +. Arrangement.length ring) 0. rings in
  Float.abs change <= (0.001 *. whole) +. (4. *. length)

(* Whether holes cover the polygon of the size [whole], with [left] left. If holes were cut off or united, a rest is
   nothing, too, if that may change as much. *)
let is_nothing changes left rings ~whole =
  let length = List.fold_left (fun sum ring -> sum +. Arrangement.length ring) 0. rings in
  Area.is_covered ~whole ~left ~length || (List.mem Holes changes && is_slight left rings ~whole)

(* A ring that crosses itself slightly encloses nearly the area that its turns give. *)
let region changes ring =
  match Arrangement.flaw ring with
  | None -> Ok [ left_turning ring ]
  | Some flaw -> (
      let ring = left_turning ring in
      let turned = area [ ring ] in
      match flaw, Arrangement.combine (fun a _ -> a) [ ring ] [] with
      | Crossing _, Some (_ :: _ as united)
        when is_slight (area united -. turned) [ ring ] ~whole:turned ->
        changes := Crossings :: !changes;
        Ok united
      | (Few | Crossing _), (Some _ | None) -> Error ())

let hole changes ring =
  match cleaned changes ring with
  | [] -> changes := Lost_holes :: !changes; Ok []
  | corners -> region changes (Array.of_list corners)

let rec regions of_one = function
  | [] -> Ok []
  | x :: others ->
    let* first = of_one x in
    let* rest = regions of_one others in
    Ok (first @ rest)

let units_per_metre = 1000.
let units x = int_of_float (Float.round (x *. units_per_metre))
let on_grid (x, y) = (units x, units y)
let off_grid (x, y) = (float_of_int x /. units_per_metre, float_of_int y /. units_per_metre)

let repaired error holes corners =
  let failed result = Result.map_error (fun () -> error) result in
  let* plane = Option.to_result ~none:Area.Too_wide (Plane.between (List.concat (corners :: holes))) in
  let ring corners = List.map (fun p -> on_grid (Plane.of_position plane p)) corners in
  let changes = ref [] in
  let* rim = failed (match cleaned changes (ring corners) with
      | [] -> Error ()
      | corners -> region changes (Array.of_list corners)) in
  let* cut = failed (regions (fun corners -> hole changes (ring corners)) holes) in
  (match error with Area.Hole_outside _ -> changes := Holes :: !changes | _ -> ());
  match Arrangement.combine (fun a b -> a && not b) rim cut with
  | None -> Error Area.Intricate
  | Some rings when not (is_slight (area rings -. (area rim -. area cut)) (rim @ cut) ~whole:(area rim)) -> Error error
  | Some rings when cut <> [] && is_nothing !changes (area rings) (rim @ cut) ~whole:(area rim) -> Error Area.Empty
  | Some rings ->
    let positions ring = List.map (fun p -> Plane.to_position plane (off_grid p)) (Array.to_list ring) in
    let* area = Area.of_rings (List.map positions rings) in
    Ok (area, List.sort_uniq Stdlib.compare !changes)

let polygon ?(holes = []) corners =
  match Area.polygon ~holes corners with
  | Ok area -> Ok (area, [])
  | Error ((Crossing _ | Hole _ | Hole_outside _) as error) -> repaired error holes corners
  | Error
      (( Radius _ | Width _ | Few_corners _ | Straight | Many_corners _ | Rims | Too_wide | Empty | Intricate | Parts _
       | Pieces _ | Uncut _ ) as error) -> Error error
