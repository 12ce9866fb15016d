include Dolphin_checker.Breadth_first.Make (Space)

let all t =
  let found = ref [] in
  iter t (fun i -> found := i :: !found);
  List.rev !found

let state t i = Space.state (system t) (load t i)
let view t i = Space.view (system t) (load t i)
let shared t i = Space.shared (system t) (load t i)
let breadth t i = Space.breadth (system t) (load t i)
let broken_by t i = Space.broken (system t) (load t i).(0)
let is_exact t i = match view t i with Exact _ -> true | Up_to _ -> false
