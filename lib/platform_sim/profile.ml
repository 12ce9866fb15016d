type course =
  | Keep
  | Reach of { height : float; rate : float }
  | Swing of { low : float; high : float; slope : float; rate : float }

type phase = { lasts : float; course : course }

(* [from]: the height when it [starts]. A swing starts between its ends. *)
type piece = { starts : float; ends : float; from : float; course : course }
type t = { pieces : piece array; first : float }

let towards from height metres =
  if from < height then Float.min height (from +. metres) else Float.max height (from -. metres)

(* Down first. [gone]: metres since it was at [high] on the way down. *)
let swing ~low ~high ~slope from seconds =
  let span = high -. low in
  let gone = Float.rem ((if from > low then high -. from else span) +. (slope *. seconds)) (2. *. span) in
  if gone <= span then high -. gone else low +. gone -. span

let after piece seconds =
  match piece.course with
  | Keep -> piece.from
  | Reach { height; rate } -> if seconds = infinity then height else towards piece.from height (rate *. seconds)
  | Swing { low; high; slope; rate = _ } -> swing ~low ~high ~slope piece.from seconds

(* {1 Making them} *)

type sketch = { reversed : piece list; time : float; now : float  (* the height *) }

let add s lasts course =
  if not (lasts > 0.) then s
  else
    let piece = { starts = s.time; ends = s.time +. lasts; from = s.now; course } in
    { reversed = piece :: s.reversed; time = piece.ends; now = after piece lasts }

let follow s { lasts; course } =
  match course with
  | Keep | Reach _ -> add s lasts course
  | Swing { low; high; slope; rate } when lasts = infinity || not (slope > 0. && high > low) ->
    add s lasts (Reach { height = (low +. high) /. 2.; rate })
  | Swing { low; high; slope = _; rate } ->
    let nearest = Float.max low (Float.min high s.now) in
    let first = Float.min lasts (Float.abs (nearest -. s.now) /. rate) in
    add (add s first (Reach { height = nearest; rate })) (lasts -. first) course

let make first phases =
  let s = List.fold_left follow { reversed = []; time = 0.; now = first } phases in
  { pieces = Array.of_list (List.rev s.reversed); first }

(* {1 Asking them} *)

(* The last piece that has started at [time] at the latest, between [low], which has, and [high]. *)
let rec current pieces time low high =
  if high - low <= 1 then pieces.(low)
  else
    let middle = (low + high) / 2 in
    if pieces.(middle).starts <= time then current pieces time middle high else current pieces time low middle

let height p time =
  match Array.length p.pieces with
  | 0 -> p.first
  | _ when time <= 0. -> p.first
  | n ->
    let piece = current p.pieces time 0 n in
    after piece (Float.min time piece.ends -. piece.starts)

let rests_from piece =
  match piece.course with
  | Keep -> piece.starts
  | Reach { height; rate } -> Float.min piece.ends (piece.starts +. (Float.abs (height -. piece.from) /. rate))
  | Swing _ -> piece.ends

(* From the last piece on in which it moves. *)
let still_from p =
  let moves piece = rests_from piece > piece.starts in
  Array.fold_left (fun last piece -> if moves piece then rests_from piece else last) 0. p.pieces
