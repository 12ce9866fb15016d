let line (p : Dolphin_checker.Limits.progress) =
  let states =
    if p.states = 0 then ""
    else Printf.sprintf " %d states, %.0f/s, frontier %d, depth %d," p.states p.rate p.frontier p.depth in
  Printf.sprintf "%s:%s %d MiB, %.0f s" p.phase states (p.memory / 1024 / 1024) p.elapsed

let every period print =
  let reported = ref 0. in
  fun (p : Dolphin_checker.Limits.progress) ->
    let periods = Float.floor (p.elapsed /. period) in
    if periods > !reported then begin
      reported := periods;
      print (line p)
    end
