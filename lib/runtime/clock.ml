type t = { elapsed : unit -> float; date : unit -> float }

let seconds ns = Int64.to_float ns *. 1e-9
let system = { elapsed = (fun () -> seconds (Mtime_clock.elapsed_ns ())); date = Unix.gettimeofday }

let stopwatch ?(at = 0.) c =
  let start = c.elapsed () -. at in
  fun () -> c.elapsed () -. start
