type quality = { loss : float; duplication : float; delay : float }
type 'a t = { random : Random.State.t; quality : quality; mutable on_way : (float * 'a) list }

let create random quality = { random; quality; on_way = [] }
let chance n share = Random.State.float n.random 1. < share

let send ~now datagram n =
  let launch () = n.on_way <- (now +. 0.001 +. Random.State.float n.random n.quality.delay, datagram) :: n.on_way in
  if not (chance n n.quality.loss) then launch ();
  if chance n n.quality.duplication then launch ()

let arrived ~now n =
  let here, there = List.partition (fun (time, _) -> time <= now) n.on_way in
  n.on_way <- there;
  List.map snd (List.sort (fun (a, _) (b, _) -> compare a b) here)
