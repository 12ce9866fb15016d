open Dolphin_platform_sim

type t = { loss : float; duplication : float; reordering : float; delay : float * float }

let none = { loss = 0.; duplication = 0.; reordering = 0.; delay = 0., 0. }
let held_back = 0.01, 0.1

(* The draws of a vehicle's tasks have names of their own; for datagrams the four of them stand for other things, and
   the draws of a copy are those of a link of another name. *)
let delay draw f =
  let least, most = f.delay in
  let delay = if most > least then Draw.between least most (draw Draw.Moment) else least in
  if f.reordering > 0. && draw Draw.Failure < f.reordering then
    delay +. Draw.between (fst held_back) (snd held_back) (draw Draw.Course)
  else delay

let delays ~seed ~link ~number f =
  if f = none then [ 0. ]
  else
    let draw = Draw.share ~seed ~vehicle:link ~start:number in
    let of_copy = Draw.share ~seed ~vehicle:(link ^ " again") ~start:number in
    if draw Draw.Length < f.loss then []
    else
      let first = delay draw f in
      if of_copy Draw.Length < f.duplication then [ first; delay of_copy f ] else [ first ]
