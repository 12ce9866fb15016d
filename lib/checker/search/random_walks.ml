module Make (S : System.S) = struct
  open Search_state.Make (S)

  (* Any of the transitions is as likely as another; each state that one leads to is seen. The result is the next
     state, or -1. *)
  let rec random_step t sample i =
    t.next <- i;
    fetch t i;
    let chosen = Array.make (States.words t.states) 0 and n = ref 0 in
    let visit key action _ =
      arrive t key action;
      incr n;
      if Sample.draw sample !n = 0 then Array.blit key 0 chosen 0 (Array.length chosen)
    in
    match S.expand t.system t.key { t.visitor with visit } with
    | taken ->
      flush t;
      if Sample.is_new sample i then t.transitions <- t.transitions + taken;
      if !n = 0 then -1 else States.find t.states chosen
    | exception S.Outgrown ->
      flush t;
      Limits.weigh t.guard ~used:(memory t) (States.bytes_to_rewrite t.states ~words:(States.words t.states + 1));
      widen t;
      random_step t sample i

  let default_length = 10_000

  let walk t sample look enough =
    let most = Option.value t.limits.max_depth ~default:default_length in
    let rec go i depth =
      t.depth <- max t.depth depth;
      worked t;
      if Sample.is_new sample i then look i;
      let next = random_step t sample i in
      Sample.visit sample i;
      if Limits.exceeds t.limits.max_states (count t) then raise (Limits.Stop States);
      if next >= 0 && depth < most && not (enough ()) then go next (depth + 1)
    in
    Sample.begin_walk sample;
    go 0 0

  let is_all_visited t sample = Sample.visited sample = count t

  let run t sample ~walks ~look ~enough =
    look_around t t.phase;
    t.depth <- 0;
    let rec from n =
      if n < walks && not (enough () || is_all_visited t sample) then begin
        walk t sample look enough;
        from (n + 1)
      end
    in
    from 0;
    if not (is_all_visited t sample) then raise (Limits.Stop Sampled)
end
