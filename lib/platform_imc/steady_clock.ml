type t = { mutable shown : float; mutable day : float }

let make ?(time = 0.) () = { shown = time; day = Unix.gettimeofday () }

let now c =
  let day = Unix.gettimeofday () in
  c.shown <- c.shown +. Float.max 0. (day -. c.day);
  c.day <- day;
  c.shown
