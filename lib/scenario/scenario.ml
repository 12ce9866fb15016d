open Dolphin_plans
open Dolphin_semantics

include Entry

let no_chart _ = Error "no file can be read here"
let read ?(chart = no_chart) ~file source = Fleet_parser.read ~chart ~file source
let replies_at = Fleet_parser.replies_at

let equal_reply (a : reply) (b : reply) = a.call = b.call && List.equal (List.equal Reply.equal) a.rounds b.rounds

let equal_input (a : input) (b : input) =
  let equal_value x y = Value.compare x y = 0 in
  a.key = b.key && a.times = b.times && a.after = b.after && List.equal (List.equal equal_value) a.rounds b.rounds

let equal_fence (a : Fences.fence) (b : Fences.fence) =
  Fences.equal_rule a.rule b.rule && a.margin = b.margin && a.text = b.text

let equal_recurrence (a : recurrence) (b : recurrence) =
  a.source = b.source
  && List.equal (fun x y -> World.compare_assumption x y = 0) a.readings b.readings

(* The rest is plain data without functions, cycles or NaN. *)
let equal (a : t) (b : t) =
  a.vehicles = b.vehicles && a.plans = b.plans && a.answers = b.answers && List.equal equal_reply a.replies b.replies
  && List.equal equal_input a.inputs b.inputs && a.samples = b.samples && List.equal equal_fence a.fences b.fences
  && a.plans_at = b.plans_at && List.equal equal_recurrence a.recurrences b.recurrences && a.begins = b.begins
  && a.zone = b.zone

let beside program = Filename.remove_extension program ^ ".fleet"

(* {1 Programs} *)

let within s (p : Core.program) =
  let own = Fences.list p.fences in
  let further = List.filter (fun fence -> not (List.memq fence own)) s.fences in
  let place = match p.place with Some _ as own -> own | None -> s.plans_at in
  let fences = if further = [] then p.fences else Fences.make (own @ further) in
  let to_compare = if Option.equal Dolphin_geo.Position.equal place p.place then further else own @ further in
  ({ p with fences; place; begins = s.begins }, to_compare)

(* {1 Questions} *)

let plan s name = List.find_opt (fun (p : plan) -> p.name = name) s.plans

let knows (p : plan) (v : vehicle) =
  let kind = String.lowercase_ascii v.kind in
  p.only = [] || List.exists (fun name -> name = v.id || String.lowercase_ascii name = kind) p.only

(* The [n]-th of these, the last for all later ones. *)
let rec nth n = function
  | [] -> None
  | [ last ] -> Some last
  | x :: rest -> if n <= 0 then Some x else nth (n - 1) rest

let answer s prompt n = Option.bind (List.find_opt (fun a -> a.prompt = prompt) s.answers) (fun a -> nth n a.texts)

let rounds s call =
  Option.map (fun (r : reply) -> r.rounds) (List.find_opt (fun (r : reply) -> r.call = call) s.replies)

let reply s call n = Option.map List.hd (Option.bind (rounds s call) (nth n))

let posted i n = List.hd (List.nth i.rounds (min n (List.length i.rounds - 1)))

let silences v =
  let before = if v.joins > 0. then [ (0., v.joins) ] else [] in
  let drops = List.map (fun drop -> (drop.from, drop.from +. drop.lasts)) v.drops in
  let after = match v.leaves with Some time -> [ (time, infinity) ] | None -> [] in
  let rec merge = function
    | (from, until) :: (from', until') :: rest when from' <= until -> merge ((from, Float.max until until') :: rest)
    | span :: rest -> span :: merge rest
    | [] -> []
  in
  before @ drops @ after
  |> List.filter (fun (from, until) -> from < until)
  |> List.sort (fun (a, _) (b, _) -> Float.compare a b)
  |> merge

(* The nearest of several values to [x]. *)
let nearest x = function
  | [] | [ _ ] -> x
  | first :: rest ->
    List.fold_left (fun best y -> if Float.abs (x -. y) < Float.abs (x -. best) then y else best) first rest

let readings samples v place ~time =
  let reading (quantity, xs) =
    match Sampled_field.value samples quantity place ~time, xs with
    | Some x, xs -> Some (quantity, nearest x xs)
    | None, first :: _ -> Some (quantity, first)
    | None, [] -> None
  in
  List.sort Stdlib.compare (List.filter_map reading v.shows)

let fields_still_from s = Sampled_field.still_from s.samples

let states s =
  let state (v : vehicle) : World.vehicle_state =
    let connected = match silences v with (from, _) :: _ -> from > 0. | [] -> true in
    { id = v.id; kind = v.kind; payload = v.payload; position = v.position;
      depth = (if v.position.height < 0. then Some (-.v.position.height) else None); altitude = None;
      battery = (if v.tells_battery then Some v.battery else None); speed = Some 0.;
      readings = readings s.samples v v.position ~time:0.; connected; unready = None;
      cruise = Some v.speed; drain = Some v.drain; progress = [] }
  in
  List.map state s.vehicles

(* {1 Writing} *)

let pp_text ppf text = Value.pp ppf (String text)
let pp_texts = Fmt.(list ~sep:(any ", ") pp_text)
let pp_number ppf n = Value.pp ppf (Value.canonical (Number n))
let pp_time ppf seconds = Format.fprintf ppf "%a.seconds" pp_number seconds

let pp_share ppf share =
  let percent = Float.round (share *. 100.) in
  let exact n = n /. 100. = share in
  let near = share *. 100. in
  if exact percent then Format.fprintf ppf "%a.percent" pp_number percent
  else if share <= 1. then pp_number ppf share
  else
    (* More than 1 is read as percent only. *)
    let candidates = [ Float.round (near *. 1e9) /. 1e9; near; Float.pred near; Float.succ near ] in
    let nearest = Option.value (List.find_opt exact candidates) ~default:near in
    Format.fprintf ppf "%a.percent" pp_number nearest

let pp_coordinates ppf (p : Dolphin_geo.Position.t) =
  Format.fprintf ppf "%a, %a" pp_number p.latitude pp_number p.longitude;
  if p.height <> 0. then Format.fprintf ppf ", %a" pp_number p.height

let pp_place ppf (p : Dolphin_geo.Position.t) =
  Format.fprintf ppf (if p.latitude < 0. then "at(%a)" else "at %a") pp_coordinates p

let pp_vehicle ppf v =
  let line fmt = Format.fprintf ppf ("  " ^^ fmt ^^ "@\n") in
  Format.fprintf ppf "vehicle %a, {@\n" pp_text v.id;
  line "type %a" pp_text v.kind;
  if v.payload <> [] then line "payload %a" pp_texts v.payload;
  List.iter (line "%a" pp_place) (if v.places = [] then [ v.position ] else v.places);
  line "speed %a" pp_number v.speed;
  if v.tells_battery then
    line "battery %a" Fmt.(list ~sep:(any ", ") pp_share) (if v.batteries = [] then [ v.battery ] else v.batteries)
  else line "battery unknown";
  line "drain %a" pp_share v.drain;
  if v.charge > 0. then line "charge %a" pp_share v.charge;
  List.iter (fun (place, radius) -> line "charger(%a, %a)" pp_coordinates place pp_number radius) v.chargers;
  let show (quantity, xs) = line "shows %a%a" pp_text quantity Fmt.(list ~sep:nop (any ", " ++ pp_number)) xs in
  List.iter show v.shows;
  if v.joins > 0. then line "joins %a" pp_time v.joins;
  Option.iter (line "leaves %a" pp_time) v.leaves;
  List.iter (fun drop -> line "drops %a, %a" pp_time drop.from pp_time drop.lasts) v.drops;
  Format.fprintf ppf "}@\n"

let pp_plan ppf (p : plan) =
  let duration ppf { least; most } =
    if least = most then Format.fprintf ppf "duration %a" pp_time least
    else Format.fprintf ppf "duration %a, %a" pp_time least pp_time most
  in
  let ending =
    match p.ending with
    | Succeeds -> []
    | May_fail share -> [ Fmt.str "mayFail %a" pp_share share ]
    | Fails -> [ "fails" ]
  in
  let settings =
    List.map (Fmt.str "%a" duration) (Option.to_list p.duration)
    @ ending
    @ List.map (Fmt.str "%a" pp_place) (Option.to_list p.place)
    @ (if p.only = [] then [] else [ Fmt.str "only %a" pp_texts p.only ])
    @ List.map (Fmt.str "charges %a" pp_share) (Option.to_list p.charges)
  in
  match settings with
  | [] -> Format.fprintf ppf "plan %a@\n" pp_text p.name
  | _ :: _ -> Format.fprintf ppf "plan %a, { %s }@\n" pp_text p.name (String.concat "; " settings)

let pp_answer ppf a = Format.fprintf ppf "answer %a, %s@\n" pp_text a.prompt (String.concat ", " a.texts)

let pp_reply ppf r = Format.fprintf ppf "reply %a, %a@\n" pp_text r.call Fmt.(list ~sep:(any ", ") Reply.pp) r.rounds

let pp_sample ppf s =
  Format.fprintf ppf "field %a, %a, at(%a)" pp_text s.quantity pp_number s.value pp_coordinates s.place;
  if s.time > 0. then Format.fprintf ppf ", after %a" pp_time s.time;
  Format.fprintf ppf "@\n"

let pp_input ppf i =
  let round ppf values = Reply.pp ppf (List.map Result.ok values) in
  Format.fprintf ppf "input %a, %a" pp_text i.key Fmt.(list ~sep:(any ", ") round) i.rounds;
  if i.times <> List.length i.rounds then Format.fprintf ppf ", times %d" i.times;
  Option.iter (Format.fprintf ppf ", after %a" pp_time) i.after;
  Format.fprintf ppf "@\n"

let pp ppf (s : t) =
  List.iter (pp_vehicle ppf) s.vehicles;
  List.iter (pp_plan ppf) s.plans;
  List.iter (pp_answer ppf) s.answers;
  List.iter (pp_reply ppf) s.replies;
  List.iter (pp_input ppf) s.inputs;
  List.iter (pp_sample ppf) s.samples;
  List.iter (fun (fence : Fences.fence) -> Format.fprintf ppf "%s@\n" fence.text) s.fences;
  Option.iter (fun place -> Format.fprintf ppf "locate(location(%a))@\n" pp_coordinates place) s.plans_at;
  Option.iter (fun begins -> Format.fprintf ppf "begins '%a'@\n" Calendar.pp_local begins) s.begins;
  Option.iter (fun zone -> Format.fprintf ppf "zone '%a'@\n" Calendar.pp_zone zone) s.zone;
  (* An entry for each vehicle is one. *)
  let add sources (r : recurrence) = if List.mem r.source sources then sources else r.source :: sources in
  List.iter (Format.fprintf ppf "%s@\n") (List.rev (List.fold_left add [] s.recurrences))

(* {1 The default} *)

let default =
  let at latitude longitude : Dolphin_geo.Position.t = { latitude; longitude; height = 0. } in
  let vehicle id kind payload position drain =
    { id; kind; payload; position; speed = Defaults.speed ~kind; battery = Defaults.battery;
      tells_battery = true; drain; charge = 0.; chargers = [];
      joins = 0.; leaves = None; drops = []; batteries = []; shows = []; places = [] } in
  let underwater id position = vehicle id "UUV" [ "DVL"; "Sidescan"; "Camera" ] position Defaults.drain in
  { vehicles =
      [ underwater "noptilus-1" (at 41.18500 (-8.70620));
        underwater "noptilus-2" (at 41.18600 (-8.70720));
        underwater "noptilus-3" (at 41.18400 (-8.70760));
        vehicle "x8-02" "UAV" [ "Camera" ] (at 41.18450 (-8.70500)) 0.4 ];
    plans = []; answers = []; replies = []; inputs = []; samples = []; fences = []; plans_at = None; recurrences = [];
    begins = None; zone = None }
