open Summary

let width = 1100.
let margin = 28.

(* {1 The head} *)

let outcome summary =
  match summary.ending with
  | None -> ("the journal breaks off", true)
  | Some { how; message = None | Some "" } -> (how, how <> "completed")
  | Some { how; message = Some message } -> (how ^ ": " ^ message, how <> "completed")

let title summary =
  match summary.header with Some h -> Filename.basename h.program.path | None -> "A run"

let circumstances summary =
  let simulated (h : Header.t) =
    let fleet = Option.fold ~none:"the built-in fleet" ~some:(fun (f : Header.source) -> Filename.basename f.path) in
    let speed = match h.speed with None -> [] | Some x -> [ Printf.sprintf "%g times real time" x ] in
    [ "simulated: " ^ fleet h.fleet; Printf.sprintf "seed %d" h.seed ] @ speed
  in
  (* Of a fleet only the answers and replies are used on a network, and nothing there depends on a seed. *)
  let length =
    match summary.clock with
    | Seconds -> Phrase.time summary.duration
    | Steps -> Phrase.count (int_of_float summary.duration) "step" ^ ", without times"
  in
  let of_header (h : Header.t) =
    (match h.platform with
     | "sim" when summary.clock = Steps ->
       [ Option.fold ~none:"the built-in fleet" ~some:(fun (f : Header.source) -> Filename.basename f.path) h.fleet ]
     | "sim" -> simulated h
     | platform -> [ Printf.sprintf "vehicles of a network (%s)" (String.uppercase_ascii platform) ])
    @ (if h.started = "" then [] else [ h.started ])
  in
  String.concat "  ·  "
    ([ Phrase.count (List.length summary.vehicles) "vehicle"; length ]
     @ Option.fold ~none:[] ~some:of_header summary.header)

let head summary =
  let text, is_bad = outcome summary in
  [ Svg.text ~name:"title" (margin, margin +. 16.) (title summary);
    Svg.text ~name:"small" (margin, margin +. 36.) (circumstances summary);
    Svg.text ~name:(if is_bad then "bad" else "small") ~anchor:End ~tip:text
      (width -. margin, margin +. 16.) (Svg.fit 520. text) ]

(* {1 The whole} *)

let has_samples summary = summary.clock = Seconds && List.exists (fun v -> v.samples <> []) summary.vehicles

let left = margin +. 62.
let map_width = 500.
let map_height summary = Float.max 330. (Tracks.height_for (List.length summary.vehicles))
let gap = 46.  (* between charts one below the other *)

(* The legend of lines below the map. *)
let legend_height = 16.

let panels summary ~y =
  if not (has_samples summary) then ([], y)
  else
    let height = map_height summary in
    let right = left +. map_width +. 82. in
    let legend = Tracks.legend summary ~x:left ~y:(y +. height +. 29.) in
    let for_legend = if legend = [] then 0. else legend_height in
    let lower = y +. height +. for_legend +. gap in
    let low = Float.max 160. (Tracks.height_for (List.length summary.vehicles)) in
    let heights, bottom =
      if not (Curves.has_heights summary) then ([], y +. height +. for_legend)
      else
        ( [ Svg.text ~name:"heading" (left, lower -. 10.) "Heights, below 0 under water";
            Curves.draw Curves.heights summary ~x:left ~y:lower ~width:(width -. margin -. left) ~height:low ],
          lower +. low )
    in
    let heading x text = Svg.text ~name:"heading" (x, y -. 10.) text in
    let key = left +. map_width -. 172. in
    let meaning x text = Svg.text ~name:"axis" (x +. 8., y -. 10.) text in
    ( [ heading left "Where they went";
        Svg.circle ~name:"key" (key, y -. 13.5) 4.;
        meaning key "first";
        Svg.circle ~name:"end-stopped" (key +. 44., y -. 13.5) 4.;
        meaning (key +. 44.) "last";
        Svg.circle ~name:"key" (key +. 86., y -. 13.5) 2.;
        meaning (key +. 86.) "a task starts";
        Tracks.draw summary ~x:left ~y ~width:map_width ~height;
        heading right "Batteries";
        Curves.draw Curves.batteries summary ~x:right ~y ~width:(width -. margin -. right) ~height ]
      @ legend @ heights,
      bottom +. 22. )

let sheet ~alone ~title ~width ~height parts =
  let size = [ ("viewBox", Printf.sprintf "0 0 %s %s" (Svg.number width) (Svg.number height)) ] in
  let fixed = [ ("width", Svg.number width); ("height", Svg.number height) ] in
  let attributes = ("xmlns", "http://www.w3.org/2000/svg") :: ("role", "img") :: (size @ if alone then fixed else []) in
  Svg.element "svg" attributes
    ([ Svg.element "title" [] [ Svg.text_only title ];
       Svg.element "style" [] [ Svg.raw ("\n" ^ Style.sheet) ];
       Svg.rect ~name:"paper" ~x:0. ~y:0. ~width ~height () ]
     @ parts)

let to_file document = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" ^ Svg.to_string document

(* The beginning of the map, and the part above it. *)
let timeline summary =
  let top = margin +. 60. in
  let timeline, height = Timeline.draw summary ~x:margin ~y:top ~width:(width -. (2. *. margin)) in
  (timeline, top +. height +. 34.)

let document ~alone summary =
  let timeline, y = timeline summary in
  let below, bottom = panels summary ~y in
  let title = "A run of a Dolphin program" in
  sheet ~alone ~title ~width ~height:(bottom +. margin) (head summary @ [ timeline ] @ below)

let svg summary = to_file (document ~alone:true summary)

(* {1 A page} *)

let page_style =
  {|
body { margin: 0 auto; max-width: 1100px; background: #ffffff; color: #1c2127; }
body { font: 14px system-ui, "Helvetica Neue", Helvetica, Arial, sans-serif; }
svg { width: 100%; height: auto; display: block; }
table { border-collapse: collapse; margin: 0 28px 40px; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: 3px 18px 3px 0; border-bottom: 1px solid #e4e8ec; }
@media screen and (prefers-color-scheme: dark) {
body { background: #14181d; color: #e6e9ed; }
th, td { border-color: #272d35; }
}
|}

let page ?(below = []) ~title picture heads rows =
  let cell name text = Svg.element name [] [ Svg.text_only text ] in
  let row name texts = Svg.element "tr" [] (List.map (cell name) texts) in
  let table = Svg.element "table" [] (row "th" heads :: List.map (row "td") rows) in
  let head =
    Svg.element "head" []
      [ Svg.raw "<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width\">\n";
        Svg.element "title" [] [ Svg.text_only title ];
        Svg.element "style" [] [ Svg.raw (page_style ^ Follow.style) ] ]
  in
  let body = Svg.element "body" [] ((Svg.element "div" [ ("class", "picture") ] [ picture ] :: below) @ [ table ]) in
  "<!DOCTYPE html>\n" ^ Svg.to_string (Svg.element "html" [ ("lang", "en") ] [ head; body ])

let rows summary =
  let of_task v (t : task) =
    let how =
      match t.ending with
      | Done -> "done"
      | Failed why -> "failed: " ^ why
      | Stopped -> "stopped"
      | Unfinished -> "not ended"
    in
    (t.from, [ moment summary t.from; moment summary t.until; v.id; t.plan; how ])
  in
  let tasks = List.concat_map (fun v -> List.map (of_task v) v.tasks) summary.vehicles in
  List.map snd (List.stable_sort (fun (a, _) (b, _) -> Float.compare a b) tasks)

let html summary =
  let heads = [ "from"; "to"; "vehicle"; "task"; "" ] in
  let moments =
    if not (has_samples summary) then List.map (fun _ -> []) summary.vehicles
    else
      Tracks.moments summary ~x:left ~y:(snd (timeline summary)) ~width:map_width ~height:(map_height summary)
  in
  let below = Follow.parts summary ~moments in
  page ~title:(title summary) ~below (document ~alone:false summary) heads (rows summary)
