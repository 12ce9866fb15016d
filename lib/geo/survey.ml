(* Metres north and east of the first corner, turned so that the lines run along the first number. *)
let turned ~bearing corners =
  let angle = Angle.radians bearing in
  let sine = sin angle and cosine = cos angle in
  let along origin p =
    let metres = Wgs84.distance origin p and course = Angle.radians (Wgs84.bearing origin p) in
    let north = metres *. cos course and east = metres *. sin course in
    ((north *. cosine) +. (east *. sine), (east *. cosine) -. (north *. sine))
  in
  let back origin (x, y) =
    Wgs84.displace origin ~north:((x *. cosine) -. (y *. sine)) ~east:((x *. sine) +. (y *. cosine))
  in
  match corners with
  | origin :: _ -> (List.map (along origin) corners, back origin)
  | [] -> ([], fun _ -> invalid_arg "Survey.turned: no corners")

let extent points =
  let ys = List.map snd points in
  (List.fold_left Float.min infinity ys, List.fold_left Float.max neg_infinity ys)

let count corners ~spacing ~bearing =
  let points, _ = turned ~bearing corners in
  let low, high = extent points in
  if points = [] then 0. else Float.max 1. (Float.ceil ((high -. low) /. spacing))

let edges points =
  match points with
  | first :: _ ->
    let rec pair = function
      | a :: (b :: _ as rest) -> (a, b) :: pair rest
      | [ last ] -> [ (last, first) ]
      | [] -> []
    in
    pair points
  | [] -> []

(* The points where the line at [y] enters and leaves the polygon, in order. *)
let crossings points y =
  let cross ((x1, y1), (x2, y2)) =
    if y1 <= y <> (y2 <= y) then Some (x1 +. ((y -. y1) /. (y2 -. y1) *. (x2 -. x1))) else None
  in
  List.sort Float.compare (List.filter_map cross (edges points))

let lines corners ~spacing ~bearing =
  if List.length corners < 3 then []
  else
    let points, back = turned ~bearing corners in
    let low, high = extent points in
    let n = int_of_float (count corners ~spacing ~bearing) in
    let line i =
      let y = low +. ((float_of_int i +. 0.5) *. (high -. low) /. float_of_int n) in
      let ends = List.map (fun x -> (x, y)) (crossings points y) in
      if i mod 2 = 0 then ends else List.rev ends
    in
    List.map back (List.concat_map line (List.init n Fun.id))

let sides = 16

let around p ~radius =
  let half = Float.pi /. float_of_int sides in
  let corner i = Wgs84.move p ~bearing:(360. *. float_of_int i /. float_of_int sides) (radius /. cos half) in
  List.init sides corner
