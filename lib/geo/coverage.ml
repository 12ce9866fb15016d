type settings = { spacing : float; bearing : float option; overlap : float; turn : float }

type error =
  | Spacing of float
  | Wide of { spacing : float; across : float }
  | Bearing of float
  | Overlap of float
  | Turn of float
  | Area of Area.error

let ( let* ) = Result.bind

let most_overlap = 0.9
let most_turn = 10_000.
let unit = 0.001

let checked { spacing; bearing; overlap; turn } =
  if not (Float.is_finite spacing && spacing > 0.) then Error (Spacing spacing)
  else if not (overlap >= 0. && overlap <= most_overlap) then Error (Overlap overlap)
  else if not (turn >= 0. && turn <= most_turn) then Error (Turn turn)
  else match bearing with Some b when not (Float.is_finite b) -> Error (Bearing b) | Some _ | None -> Ok ()

(* The farthest that two corners are apart, but for the 1.5 percent of 10 degrees. *)
let extent region =
  let wide angle =
    let slide (x, y) = (float_of_int x *. cos angle) +. (float_of_int y *. sin angle) in
    let all = List.concat_map (fun ring -> List.map slide (Array.to_list ring)) region in
    List.fold_left Float.max neg_infinity all -. List.fold_left Float.min infinity all
  in
  let widths = List.init 18 (fun i -> wide (Float.pi *. float_of_int i /. 18.)) in
  unit *. List.fold_left Float.max 0. widths

(* Two points for a strip, and those on the way to the next one. *)
let rec points parts tours ~turn = function
  | [] -> []
  | (strip : Tour.strip) :: rest ->
    let part = parts.(strip.part) in
    let left = (part.Bands.left -. turn, part.height) and right = (part.right +. turn, part.height) in
    let between = match rest with next :: _ -> Tour.way tours strip next | [] -> [] in
    (if strip.rightwards then [ left; right ] else [ right; left ]) @ between @ points parts tours ~turn rest

(* Strips at an angle; [about] is how long a way along them is if each step to the next one is as short as it can be. *)
type strips = { angle : float; parts : Bands.part array; about : float }

let strips region settings angle =
  match Slabs.make ~angle region with
  | None -> None
  | Some slabs ->
    let step = settings.spacing *. (1. -. settings.overlap) /. unit in
    let high = slabs.heights.(Array.length slabs.heights - 1) -. slabs.heights.(0) in
    if high /. step > float_of_int Area.most_points then None
    else
      let parts = Bands.make slabs ~most:step in
      let add sum (part : Bands.part) = sum +. (part.right -. part.left) +. step in
      if parts = [||] || 2 * Array.length parts > Area.most_points then None
      else Some { angle; parts; about = Array.fold_left add 0. parts }

type found = { angle : float; way : (float * float) list; length : float }

let along settings ({ angle; parts; _ } : strips) =
  let tours = Tour.make parts in
  let tour = Tour.shortest tours in
  let way = points parts tours ~turn:(settings.turn /. unit) tour in
  if List.length way > Area.most_points then None else Some { angle; way; length = Tour.length tours tour }

(* Tours take most of the time: with many strips, only those of the most promising bearings are tried. *)
let most_strips = 400

let promising region (all : strips list) =
  if not (Division.is_large region) then all
  else
    let sorted = List.stable_sort (fun (a : strips) b -> Float.compare a.about b.about) all in
    let rec take count = function
      | (x : strips) :: rest when count = 0 || count + Array.length x.parts <= most_strips ->
        x :: take (count + Array.length x.parts) rest
      | _ :: _ | [] -> []
    in
    take 0 sorted

let angles region = function
  | Some bearing -> [ Angle.radians (90. -. bearing) ]
  | None when Division.is_large region -> Division.directions ~evenly:4 ~sides:2 region
  | None -> Division.directions ~evenly:12 ~sides:4 region

let points settings area =
  let* () = checked settings in
  let* plane, region = Result.map_error (fun e -> Area e) (Area.on_plane area) in
  let across = extent region in
  if settings.spacing > across then Error (Wide { spacing = settings.spacing; across })
  else
    let all = List.filter_map (strips region settings) (angles region settings.bearing) in
    let found = List.filter_map (along settings) (promising region all) in
    match List.stable_sort (fun a b -> Float.compare a.length b.length) found with
    | [] -> Error (Area Intricate)
    | { angle; way; _ } :: _ ->
      let place p =
        let x, y = Slabs.back ~angle p in
        Plane.to_position plane (x *. unit, y *. unit)
      in
      Ok (List.map place way)

let pp_error ppf = function
  | Spacing x -> Fmt.pf ppf "the spacing of strips is above 0 m, not %g" x
  | Wide { spacing; across } ->
    Fmt.pf ppf "the spacing, %g m, is wider than the area, which is %.0f m across" spacing across
  | Bearing x -> Fmt.pf ppf "a bearing is a finite number of degrees, not %g" x
  | Overlap x ->
    Fmt.pf ppf "strips overlap by 0 to %g of their width, not by %g; write 10.percent" most_overlap x
  | Turn x -> Fmt.pf ppf "a turn takes 0 to %g m, not %g" most_turn x
  | Area error -> Area.pp_error ppf error
