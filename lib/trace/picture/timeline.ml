open Summary

(* Everything is placed on this. *)
(* [moment] is the format of times. *)
type frame = { left : float; right : float; seconds : float; moment : float -> string }

let at f time = f.left +. ((f.right -. f.left) *. time /. f.seconds)
let char_height = 13.

(* {1 The program's row} *)

let shape activity (x, y) tip =
  let n = Svg.number in
  match activity with
  | Posted _ ->
    Svg.path ~name:"post" ~tip (Printf.sprintf "M%s,%s l4.5,8 h-9 z" (n x) (n (y -. 4.)))
  | Consumed _ -> Svg.path ~name:"consume" ~tip (Printf.sprintf "M%s,%s l4.5,-8 h-9 z" (n x) (n (y +. 4.)))
  | Said _ -> Svg.circle ~name:"say" ~tip (x, y) 4.
  | Asked _ -> Svg.circle ~name:"ask" ~tip (x, y) 4.
  | Erred _ ->
    Svg.path ~name:"error" ~tip (Printf.sprintf "M%s,%s l8,8 m0,-8 l-8,8" (n (x -. 4.)) (n (y -. 4.)))

let words = function
  | Posted pair -> "posts " ^ pair
  | Consumed pair -> "consumes " ^ pair
  | Said text -> "says: " ^ text
  | Asked text -> "asks: " ^ text
  | Erred why -> "error: " ^ why

let sort = function Posted _ -> 0 | Consumed _ -> 1 | Said _ -> 2 | Asked _ -> 3 | Erred _ -> 4

let label = function
  | Posted pair | Consumed pair -> pair
  | Said text | Asked text -> "“" ^ text ^ "”"
  | Erred why -> why

let most_levels = 7
let longest_label = 330.

(* Marks with labels that do not overlap: each on the lowest level on which there is room for it. Marks whose labels
   have no room stand below these, without. *)
let place f activities =
  let free = Array.make most_levels neg_infinity in
  let levels = ref 1 in
  let mark (time, activity) =
    let x = at f time in
    let text = Svg.fit ~size:10. longest_label (label activity) in
    let size = match activity with Erred _ -> 11.2 | Posted _ | Consumed _ | Said _ | Asked _ -> 10. in
    let width = Svg.width ~size text +. 18. in
    let from = if x +. width > f.right +. 8. then x -. width else x -. 6. in
    let until = if x +. width > f.right +. 8. then x +. 8. else x +. width in
    let rec level i = if i >= most_levels then None else if free.(i) <= from then Some i else level (i + 1) in
    match level 0 with
    | None -> (x, 0, from < x -. 6., activity, "", time)
    | Some i ->
      free.(i) <- until;
      levels := max !levels (i + 1);
      (x, i, from < x -. 6., activity, text, time)
  in
  (* If there is no room for all labels, one mark stands for those that it would cover. *)
  let covered = Hashtbl.create 8 in
  let add marks ((x, _, _, activity, text, _) as mark) =
    let kind = sort activity in
    let is_covered = match Hashtbl.find_opt covered kind with Some x' -> x -. x' < 4. | None -> false in
    if text = "" && is_covered then marks
    else begin
      if text = "" then Hashtbl.replace covered kind x;
      mark :: marks
    end
  in
  let marks = List.rev (List.fold_left (fun marks activity -> add marks (mark activity)) [] activities) in
  if Hashtbl.length covered = 0 then (marks, !levels)
  else
    let raise_labelled (x, i, leftwards, activity, text, time) =
      (x, (if text = "" then i else i + 1), leftwards, activity, text, time)
    in
    (List.map raise_labelled marks, !levels + 1)

let level_height = 15.

let draw_mark f base (x, level, leftwards, activity, text, time) =
  let y = base -. (float_of_int level *. level_height) in
  let tip = Printf.sprintf "%s  %s" (f.moment time) (words activity) in
  let anchor, dx = if leftwards then (Svg.End, -8.) else (Svg.Start, 8.) in
  let name = match activity with Erred _ -> "axis bad" | Posted _ | Consumed _ | Said _ | Asked _ -> "axis" in
  shape activity (x, y) tip :: (if text = "" then [] else [ Svg.text ~name ~anchor ~tip (x +. dx, y +. 3.5) text ])

(* {1 Rows of vehicles} *)

let describe f v (task : task) =
  let how =
    match task.ending with
    | Done -> "done"
    | Failed why -> "failed: " ^ why
    | Stopped -> "stopped"
    | Unfinished -> "not ended"
  in
  Printf.sprintf "%s runs %s from %s to %s: %s" v.id task.plan (f.moment task.from) (f.moment task.until) how

let least_width = 2.

(* A task as it is drawn; without a [name], its bar is too narrow for it. *)
type drawn_task = {
  bar : Svg.t;
  name : Svg.t list;
  finish : Svg.t list;  (* how it ended *)
  from : float;
  task : task;
}

let draw_task f colour v ~y ~height (task : task) =
  let x = at f task.from in
  let width = Float.max least_width (at f task.until -. x -. 1.) in
  let tip = describe f v task in
  let kind =
    match task.ending with Done -> "" | Failed _ -> " failed" | Stopped -> " stopped" | Unfinished -> " unfinished"
  in
  let bar = Svg.rect ~name:("bar " ^ colour ^ kind) ~round:3. ~tip ~x ~y ~width ~height () in
  let right = x +. width in
  let n = Svg.number in
  let finish, taken =
    match task.ending with
    | Done | Unfinished -> ([], 0.)
    | Failed _ ->
      let cross = Printf.sprintf "M%s,%s l9,9 m0,-9 l-9,9" (n (right -. 4.5)) (n (y +. (height /. 2.) -. 4.5)) in
      ([ Svg.path ~name:"end-failed" ~tip cross ], 6.)
    | Stopped ->
      ([ Svg.rect ~name:"end-stopped" ~tip ~x:(right -. 3.) ~y:(y -. 2.) ~width:3. ~height:(height +. 4.) () ], 4.)
  in
  let text = Svg.fit (width -. 6. -. taken) task.plan in
  let legible = text <> "" && (Svg.width text > 14. || text = task.plan) in
  let name = if legible then [ Svg.text ~name:"within" ~tip (x +. 4., y +. (height /. 2.) +. 4.) text ] else [] in
  { bar; name; finish; from = x; task }

(* {2 Names of narrow bars}

   They stand below the bars, each group where its first bar begins, one name after the other. *)

let lane_height = 12.
let legible_height = 12.
let size_below = 10.

(* [x] is the beginning of the first bar, [width] that of the names with ", " between them; the names are reversed. *)
type group = { x : float; width : float; names : string list }

let width_below = Svg.width ~size:size_below

(* From the left; groups that would overlap are one. *)
let groups f drawn =
  let rec add groups group =
    let x = Float.max f.left (Float.min group.x (f.right -. group.width)) in
    match groups with
    | last :: others when last.x +. last.width +. 10. > x ->
      add others
        { x = last.x; width = last.width +. width_below ", " +. group.width; names = group.names @ last.names }
    | _ -> { group with x } :: groups
  in
  let alone d =
    if d.name = [] then Some { x = d.from; width = width_below d.task.plan; names = [ d.task.plan ] } else None
  in
  let text group = String.concat ", " (List.rev group.names) in
  List.rev_map (fun group -> (group.x, text group)) (List.fold_left add [] (List.filter_map alone drawn))

let names_below f i ~y drawn =
  let label (x, names) =
    let text = Svg.fit ~size:size_below (f.right +. 1. -. x) names in
    Svg.text ~name:("name below " ^ Style.vehicle i) ~tip:names (x, y) text
  in
  List.map label (groups f drawn)

(* The row of [v], and how high it is. *)
let draw_row f i v ~y ~row =
  let colour = Style.vehicle i in
  let height = Float.min 22. (row -. 8.) in
  let top = y +. ((row -. height) /. 2.) in
  let band (s : span) =
    let x = at f s.from in
    Svg.rect ~name:"held" ~round:3. ~x ~y:(top -. 3.) ~width:(at f s.until -. x) ~height:(height +. 6.) ()
  in
  let silence (s : span) =
    let x = at f s.from in
    let tip = Printf.sprintf "%s has no link from %s to %s" v.id (f.moment s.from) (f.moment s.until) in
    Svg.rect ~name:"silent" ~tip ~x ~y:(top +. height +. 1.) ~width:(Float.max 2. (at f s.until -. x)) ~height:3. ()
  in
  let drawn = List.map (draw_task f colour v ~y:top ~height) v.tasks in
  let is_legible = height >= legible_height in
  let within = if is_legible then List.concat_map (fun d -> d.name) drawn else [] in
  let below = if is_legible then names_below f i ~y:(y +. row +. 8.) drawn else [] in
  let name =
    Svg.text ~name:("name " ^ colour) ~anchor:End (f.left -. 10., top +. (height /. 2.) +. 4.) (Svg.fit 150. v.id)
  in
  (* How a task ended is seen even if another one begins at once. *)
  let parts =
    List.map band v.held @ List.map (fun d -> d.bar) drawn @ within @ List.concat_map (fun d -> d.finish) drawn
    @ List.map silence v.silent @ below @ [ name ] in
  (Style.group i parts, if below = [] then row else row +. lane_height)

(* One below the other from [y] on, and their end. *)
let draw_rows f vehicles ~y ~row =
  let add (i, y, rows) v =
    let drawn, height = draw_row f i v ~y ~row in
    (i + 1, y +. height, drawn :: rows)
  in
  let _, bottom, rows = List.fold_left add (0, y, []) vehicles in
  (List.rev rows, bottom)

(* {1 The legend} *)

let has_activity p summary = List.exists (fun (_, activity) -> p activity) summary.activities
let exists_task p summary = List.exists (fun v -> List.exists (fun (t : task) -> p t.ending) v.tasks) summary.vehicles

let exists_failure summary =
  has_activity (function Erred _ -> true | _ -> false) summary
  || exists_task (function Failed _ -> true | _ -> false) summary

let legend summary ~x ~y =
  let activity p sample text =
    if has_activity p summary then [ ((fun x -> shape sample (x, y -. 3.5) text), text) ] else [] in
  let n = Svg.number in
  let cross x = Svg.path ~name:"end-failed" (Printf.sprintf "M%s,%s l8,8 m0,-8 l-8,8" (n (x -. 4.)) (n (y -. 8.))) in
  let block x = Svg.rect ~name:"end-stopped" ~x:(x -. 1.5) ~y:(y -. 11.) ~width:3. ~height:14. () in
  let strip x = Svg.rect ~name:"silent" ~x:(x -. 6.) ~y:(y -. 5.) ~width:12. ~height:3. () in
  let items =
    activity (function Posted _ -> true | _ -> false) (Posted "") "posts"
    @ activity (function Consumed _ -> true | _ -> false) (Consumed "") "consumes"
    @ activity (function Asked _ -> true | _ -> false) (Asked "") "asks"
    @ activity (function Said _ -> true | _ -> false) (Said "") "says"
    @ (if exists_failure summary then [ (cross, "fails") ] else [])
    @ (if exists_task (function Stopped -> true | _ -> false) summary then [ (block, "is stopped") ] else [])
    @ if List.exists (fun v -> v.silent <> []) summary.vehicles then [ (strip, "no link") ] else []
  in
  let add (x, drawn) (shape, text) =
    (x +. 28. +. Svg.width ~size:10. text, drawn @ [ shape x; Svg.text ~name:"axis" (x +. 9., y) text ])
  in
  snd (List.fold_left add (x +. 4., []) items)

(* {1 All of it} *)

(* More lines than that would be a curtain. *)
let most_guides = 40

let gutter summary =
  let widest = List.fold_left (fun w v -> Float.max w (Svg.width ~size:12. v.id)) 46. summary.vehicles in
  Float.min 165. widest +. 16.

(* When the run began, in seconds since 1970, if its times are those of clocks on a wall. *)
let began summary =
  match summary.clock, summary.header with
  | Seconds, Some (h : Header.t) when h.platform <> "sim" || h.speed = Some 1. -> Header.of_utc h.started
  | (Seconds | Steps), (Some _ | None) -> None

let on_the_wall seconds =
  let seconds = int_of_float (Float.round seconds) mod 86400 in
  Printf.sprintf "%02d:%02d:%02d" (seconds / 3600) (seconds / 60 mod 60) (seconds mod 60)

let draw summary ~x ~y ~width =
  let seconds = if summary.duration > 0. then summary.duration else 1. in
  let f = { left = x +. gutter summary; right = x +. width -. 14.; seconds; moment = Summary.moment summary } in
  let marks, levels = place f summary.activities in
  let base = y +. (float_of_int levels *. level_height) +. 2. in
  let count = List.length summary.vehicles in
  let row = if count <= 24 then 34. else if count <= 80 then 22. else 14. in
  let rows_top = base +. 14. in
  let rows, rows_bottom = draw_rows f summary.vehicles ~y:rows_top ~row in
  let bottom = rows_bottom +. 4. in
  let step =
    match summary.clock with
    | Seconds -> Scale.time_step ~most:12 seconds
    | Steps -> Float.max 1. (Scale.step ~most:12 seconds)
  in
  let label time = match summary.clock with Seconds -> Phrase.time time | Steps -> Printf.sprintf "%.0f" time in
  let began = began summary in
  let wall x text = Svg.text ~name:"axis wall" ~anchor:Middle (x, bottom +. (2. *. char_height)) text in
  let tick time =
    let x = at f time in
    [ Svg.line ~name:"grid" (x, y) (x, bottom);
      Svg.text ~name:"axis" ~anchor:Middle (x, bottom +. char_height) (label time) ]
    @ Option.fold began ~none:[] ~some:(fun began -> [ wall x (on_the_wall (began +. time)) ])
  in
  let deeper =
    match began with
    | None -> []
    | Some _ -> [ Svg.text ~name:"axis" ~anchor:End (f.left -. 28., bottom +. (2. *. char_height)) "UTC" ]
  in
  let bottom_of_axis = if began = None then bottom else bottom +. char_height in
  let guide (x, level, _, activity, _, _) =
    let top = base -. (float_of_int level *. level_height) +. 5. in
    match activity with
    | Posted _ | Consumed _ | Erred _ -> [ Svg.line ~name:"guide" (x, top) (x, bottom) ]
    | Said _ | Asked _ -> []
  in
  let guides = if List.length marks > most_guides then [] else List.concat_map guide marks in
  let program =
    Svg.text ~name:"small" ~anchor:End (f.left -. 10., base +. 4.) "program"
    :: List.concat_map (draw_mark f base) marks
  in
  let parts =
    List.concat_map tick (Scale.multiples step ~from:0. ~until:seconds)
    @ [ Svg.line ~name:"frame" (f.left, bottom) (f.right, bottom) ]
    @ rows @ guides @ program
    @ deeper
    @ legend summary ~x:f.left ~y:(bottom_of_axis +. 34.)
  in
  (Svg.chart ~left:f.left ~right:f.right ~top:y ~bottom parts, bottom_of_axis +. 40. -. y)
