open Dolphin_trace
module Distribution = Dolphin_statistics.Distribution

let width = 1100.
let margin = 28.
let most_bars = 40

(* Seconds from left to right, and runs from the bottom up. *)
type frame = { left : float; right : float; top : float; bottom : float; from : float; until : float; most : int }

let at f seconds = f.left +. ((f.right -. f.left) *. (seconds -. f.from) /. (f.until -. f.from))
let up f count = f.bottom -. ((f.bottom -. f.top) *. Float.of_int count /. Float.of_int f.most)

let bar f (b : Distribution.bin) =
  let time = Sampling_report.time in
  let tip = Printf.sprintf "%s from %s to %s" (Phrase.count b.count "run") (time b.from) (time b.until) in
  let x = at f b.from and y = up f b.count in
  Svg.rect ~name:"bar v0" ~tip ~x ~y ~width:(Float.max 1. (at f b.until -. x -. 1.)) ~height:(f.bottom -. y) ()

(* Each on a level of its own above the bars. *)
let quantile f d level (q, name) =
  let seconds = Distribution.quantile q d in
  let x = at f seconds and y = f.top -. (12. *. Float.of_int level) in
  let anchor : Svg.anchor = if x > (f.left +. f.right) /. 2. then End else Start in
  let label = Printf.sprintf "%s over by %s" name (Sampling_report.time seconds) in
  [ Svg.line ~name:"limit" (x, y -. 9.) (x, f.bottom);
    Svg.text ~name:"axis" ~anchor ((if anchor = End then x -. 4. else x +. 4.), y) label ]

let tick f seconds =
  let x = at f seconds in
  [ Svg.line ~name:"grid" (x, f.top) (x, f.bottom);
    Svg.text ~name:"axis" ~anchor:Middle (x, f.bottom +. 13.) (Phrase.time seconds) ]

let completed d =
  let bins = Distribution.bins ~most:most_bars d in
  let first = List.hd bins and last = List.nth bins (List.length bins - 1) in
  let most = List.fold_left (fun n (b : Distribution.bin) -> max n b.count) 1 bins in
  let f =
    { left = margin +. 40.; right = width -. margin; top = margin +. 100.; bottom = 380.; from = first.from;
      until = last.until; most }
  in
  let step = Scale.time_step ~most:12 (f.until -. f.from) in
  let count n = Svg.text ~name:"axis" ~anchor:End (f.left -. 6., up f n +. 4.) (string_of_int n) in
  List.concat_map (tick f) (Scale.multiples step ~from:f.from ~until:f.until)
  @ List.map (bar f) bins
  @ List.concat (List.mapi (quantile f d) [ (0.05, "5 %"); (0.5, "50 %"); (0.95, "95 %") ])
  @ [ Svg.line ~name:"frame" (f.left, f.bottom) (f.right, f.bottom); count most; count 0 ]

let head (p : Program_file.t) (s : Sampling.t) =
  let n = Distribution.size s.completed in
  let words = Printf.sprintf "when runs are over: %d of %s completed" n (Phrase.count s.runs "run") in
  [ Svg.text ~name:"title" (margin, margin +. 16.) (Filename.basename p.path);
    Svg.text ~name:"small" (margin, margin +. 36.) words ]

let document ~alone p (s : Sampling.t) =
  let drawn = if Distribution.is_empty s.completed then [] else completed s.completed in
  Picture.sheet ~alone ~title:"When simulated runs of a Dolphin program are over" ~width ~height:(400. +. margin)
    (head p s @ drawn)

let svg p s = Picture.to_file (document ~alone:true p s)

let html (p : Program_file.t) (s : Sampling.t) =
  let row (e : Sampling.ending) =
    [ string_of_int e.runs; Sampling_report.percent (Float.of_int e.runs /. Float.of_int s.runs);
      string_of_int e.seed; Sampling_report.ending p e.ending ]
  in
  Picture.page ~title:(Filename.basename p.path) (document ~alone:false p s) [ "runs"; "share"; "seed"; "end" ]
    (List.map row s.endings)
