open Dolphin_time
open Dolphin_trace
module Timed_analysis = Dolphin_time.Timed_analysis

let width = 1100.
let margin = 28.

(* {1 What is drawn} *)

type row = {
  task : Timed_analysis.task;
  starts : Timed_analysis.window;
  ends : Timed_analysis.window option;  (* however it ends; [None]: it does not *)
  tip : string;
}

let later (a : Timed_analysis.date) (b : Timed_analysis.date) : Timed_analysis.date =
  match a, b with Unbounded, _ | _, Unbounded -> Unbounded | At m, At n -> At (max m n)

(* However it may end: the earliest and the latest of all ways. *)
let any_end windows =
  let ends = List.filter_map (fun m -> List.assoc_opt m windows) [ Timed_system.Ends; Fails; Stopped ] in
  let both (a : Timed_analysis.window) (b : Timed_analysis.window) =
    { Timed_analysis.earliest = min a.earliest b.earliest; latest = later a.latest b.latest } in
  match ends with [] -> None | first :: rest -> Some (List.fold_left both first rest)

let row p ((task : Timed_analysis.task), windows) =
  let named m w = Timed_system.moment_name m ^ " " ^ Time_report.window w in
  let moment m = Option.map (named m) (List.assoc_opt m windows) in
  let words = List.filter_map moment Time_report.moments in
  let place = Option.fold (Program_file.at p task.site) ~none:"" ~some:(fun at -> " (" ^ at ^ ")") in
  let tip = Printf.sprintf "%s on %s%s: %s" task.name task.vehicle place (String.concat ", " words) in
  Option.map (fun starts -> { task; starts; ends = any_end windows; tip }) (List.assoc_opt Timed_system.Starts windows)

(* The rows of each vehicle together, by their earliest starts. *)
let rows p (o : Timed_analysis.outcome) =
  let all = List.filter_map (row p) o.tasks in
  let vehicles =
    List.fold_left (fun vs r -> if List.mem r.task.vehicle vs then vs else r.task.vehicle :: vs) [] all in
  let of_vehicle v =
    let end_of r = Option.fold r.ends ~none:max_int ~some:(fun (w : Timed_analysis.window) -> w.earliest) in
    let key r = (r.starts.earliest, end_of r) in
    (v, List.stable_sort (fun a b -> compare (key a) (key b)) (List.filter (fun r -> r.task.vehicle = v) all))
  in
  List.map of_vehicle (List.rev vehicles)

(* {1 Time from left to right} *)

type frame = { left : float; right : float; until : int }  (* milliseconds *)

let at f ms = f.left +. ((f.right -. f.left) *. Float.of_int ms /. Float.of_int f.until)

(* The last date that there is, and a little more if something has none. *)
let until ?deadline (o : Timed_analysis.outcome) =
  let windows = List.map snd o.endings @ List.concat_map (fun (_, ws) -> List.map snd ws) o.tasks in
  let last (w : Timed_analysis.window) = match w.latest with At n -> n | Unbounded -> w.earliest in
  let most = List.fold_left (fun n w -> max n (last w)) (Option.value deadline ~default:0) windows in
  let is_open (w : Timed_analysis.window) = w.latest = Unbounded in
  let has_open = o.endless <> None || List.exists is_open windows in
  max 1_000 (if has_open then most * 11 / 10 else most)

(* {1 Bars} *)

let bar f ~colour ~y ~height r =
  let rect ?(name = "") from until =
    let x = at f from in
    Svg.rect ~name:("bar " ^ colour ^ name) ~tip:r.tip ~x ~y ~width:(Float.max 1.5 (at f until -. x)) ~height () in
  let arrow y =
    let n = Svg.number in
    let path = Printf.sprintf "M%s,%s l7,%s l-7,%s z" (n f.right) (n y) (n (height /. 2.)) (n (height /. 2.)) in
    Svg.path ~name:("bar open " ^ colour) ~tip:r.tip path
  in
  let last (w : Timed_analysis.window) = match w.latest with At n -> (n, false) | Unbounded -> (f.until, true) in
  let ends = Option.value r.ends ~default:{ Timed_analysis.earliest = f.until; latest = Unbounded } in
  let latest_start, _ = last r.starts and latest_end, is_open = last ends in
  let parts =
    if latest_start >= ends.earliest then [ rect ~name:" open" r.starts.earliest latest_end ]
    else
      [ rect ~name:" open" r.starts.earliest latest_start; rect latest_start ends.earliest;
        rect ~name:" open" ends.earliest latest_end ]
  in
  let is_empty from until = from = until in
  let parts =
    match parts with
    | [ before; sure; after ] ->
      (if is_empty r.starts.earliest latest_start then [] else [ before ])
      @ [ sure ]
      @ if is_empty ends.earliest latest_end then [] else [ after ]
    | parts -> parts
  in
  parts @ if is_open then [ arrow y ] else []

(* {1 Lines that concern all} *)

let level_height = 12.

(* Each with its label on a level of its own above the bars, and its line up to there. *)
let limits ?deadline f (o : Timed_analysis.outcome) =
  let line name label ms ~top ~bottom level =
    let x = at f ms and y = top -. (level_height *. Float.of_int level) in
    let anchor : Svg.anchor = if x > (f.left +. f.right) /. 2. then End else Start in
    let dx = if anchor = End then -4. else 4. in
    let text = if name = "limit late" then "axis bad" else "axis" in
    [ Svg.line ~name (x, y -. 9.) (x, bottom); Svg.text ~name:text ~anchor (x +. dx, y) label ]
  in
  let of_ending (e, (w : Timed_analysis.window)) =
    let name = Timed_system.ending_name e in
    let limit word n = line "limit" (Printf.sprintf "%s %s %s" name word (Time_report.time n)) n in
    match w.latest with
    | At n when n = w.earliest -> [ limit "at" n ]
    | At n -> [ limit "from" w.earliest; limit "until" n ]
    | Unbounded -> [ limit "from" w.earliest ]
  in
  let due = Option.map (fun n -> line "limit late" ("deadline " ^ Time_report.time n) n) deadline in
  let lines = List.concat_map of_ending o.endings @ Option.to_list due in
  (List.length lines, fun ~top ~bottom -> List.concat (List.mapi (fun level line -> line ~top ~bottom level) lines))

(* {1 The whole} *)

let head p ?deadline (o : Timed_analysis.outcome) =
  let words =
    match Timed_analysis.shortfall ?deadline o, Timed_analysis.latest o with
    | Some Never_ends, _ -> ("some run never ends", true)
    | Some Late, _ -> ("some run is late", true)
    | Some Fails, _ -> ("some run fails", true)
    | Some Misses, _ -> ("some task is not done within its time", true)
    | Some Empty, _ -> ("some battery runs empty", true)
    | Some Too_near, _ -> ("plans side by side come too near", true)
    | Some Unknown, _ -> ("inconclusive", true)
    | None, Some (At n) -> ("over at " ^ Time_report.time n ^ " at the latest", false)
    | None, (Some Unbounded | None) -> ("no latest time", false)
  in
  let text, is_bad = words in
  [ Svg.text ~name:"title" (margin, margin +. 16.) (Filename.basename p.Program_file.path);
    Svg.text ~name:"small" (margin, margin +. 36.) "when its tasks may run, in all runs";
    Svg.text ~name:(if is_bad then "bad" else "small") ~anchor:End (width -. margin, margin +. 16.) text ]

let legend ~x ~y =
  [ Svg.rect ~name:"bar v0" ~x ~y:(y -. 9.) ~width:18. ~height:10. ();
    Svg.text ~name:"axis" (x +. 24., y) "runs, if it runs at all";
    Svg.rect ~name:"bar open v0" ~x:(x +. 150.) ~y:(y -. 9.) ~width:18. ~height:10. ();
    Svg.text ~name:"axis" (x +. 174., y) "may run: from its earliest start, to its latest end" ]

let document ~alone ?deadline p (o : Timed_analysis.outcome) =
  let groups = rows p o in
  let count = List.fold_left (fun n (_, rows) -> n + List.length rows) 0 groups in
  let row = if count <= 30 then 24. else if count <= 80 then 18. else 13. in
  let height = row -. 6. in
  let widest size names = List.fold_left (fun w text -> Float.max w (Svg.width ~size text)) 40. names in
  let vehicles = Float.min 150. (widest 12. (List.map fst groups)) in
  let names = List.concat_map (fun (_, rows) -> List.map (fun r -> r.task.name) rows) groups in
  let tasks = Float.min 150. (widest 11. names) in
  let f = { left = margin +. vehicles +. tasks +. 26.; right = width -. margin -. 10.; until = until ?deadline o } in
  let lines, limits = limits ?deadline f o in
  let top = margin +. 56. +. (level_height *. Float.of_int lines) in
  let rows_top = top +. 10. in
  let gap = 6. in
  let bottom = rows_top +. (Float.of_int count *. row) +. (Float.of_int (List.length groups) *. gap) in
  let step = Scale.time_step ~most:12 (Float.of_int f.until /. 1000.) in
  let tick seconds =
    let x = at f (Float.to_int (seconds *. 1000.)) in
    [ Svg.line ~name:"grid" (x, top) (x, bottom);
      Svg.text ~name:"axis" ~anchor:Middle (x, bottom +. 13.) (Phrase.time seconds) ]
  in
  let group (y, i, drawn) (v, rows) =
    let colour = Style.vehicle i in
    let line k r =
      let y = y +. (Float.of_int k *. row) in
      let name = Svg.fit tasks r.task.name in
      Svg.text ~name:"small" ~anchor:End ~tip:r.tip (f.left -. 10., y +. (height /. 2.) +. 4.) name
      :: bar f ~colour ~y ~height r
    in
    let name = Svg.text ~name:("name " ^ colour) (margin, y +. (height /. 2.) +. 4.) (Svg.fit ~size:12. vehicles v) in
    (y +. (Float.of_int (List.length rows) *. row) +. gap, i + 1, drawn @ (name :: List.concat (List.mapi line rows)))
  in
  let _, _, drawn = List.fold_left group (rows_top, 0, []) groups in
  let ticks = List.concat_map tick (Scale.multiples step ~from:0. ~until:(Float.of_int f.until /. 1000.)) in
  Picture.sheet ~alone ~title:"When the tasks of a Dolphin program may run" ~width ~height:(bottom +. 40. +. margin)
    (head p ?deadline o @ ticks
     @ [ Svg.line ~name:"frame" (f.left, bottom) (f.right, bottom) ]
     @ drawn @ limits ~top ~bottom
     @ legend ~x:f.left ~y:(bottom +. 36.))

let svg ?deadline p o = Picture.to_file (document ~alone:true ?deadline p o)

let html ?deadline p o =
  let heads = "vehicle" :: "task" :: List.map Timed_system.moment_name Time_report.moments @ [ "where" ] in
  let row ((task : Timed_analysis.task), windows) =
    let cell m = Option.fold (List.assoc_opt m windows) ~none:"" ~some:Time_report.window in
    let where = Option.value (Program_file.at p task.site) ~default:"" in
    (task.vehicle :: task.name :: List.map cell Time_report.moments) @ [ where ]
  in
  let title = Filename.basename p.Program_file.path in
  Picture.page ~title (document ~alone:false ?deadline p o) heads (List.map row o.tasks)
