module Make (S : System.S) = struct
  open Search_state.Make (S)

  let here = -1

  (* The numbers of [states], a run. *)
  let numbers_of t states =
    let number key =
      if States.find t.states key < 0 then begin
        States.push t.states key ~parent:0 ~fresh:(fun _ _ -> ());
        States.flush t.states ~fresh:(fun _ _ -> ())
      end;
      States.find t.states key
    in
    List.map number states

  (* The number of the last of [states], a run. *)
  let keep_run t deep states =
    let numbers = numbers_of t states in
    let last = List.nth numbers (List.length numbers - 1) in
    if not (Hashtbl.mem deep.runs last) then Hashtbl.add deep.runs last numbers;
    last

  let keep t i =
    match t.deep with Some deep when i = here -> keep_run t deep (Trail.path deep.trail) | Some _ | None -> i

  let hash t deep key =
    Bitstate.begin_state deep.bits;
    S.numbers t.system key (Bitstate.add deep.bits);
    Bitstate.hash deep.bits

  let look_for_cycle t deep key hash =
    if deep.cycle = None then
      match Trail.depth_on_path deep.trail ~hash key with
      | Some place -> deep.cycle <- Some (numbers_of t (Trail.path deep.trail), place)
      | None -> ()

  let visit_deep t deep depth key =
    worked t;
    (match S.broken t.system key.(0) with
     | Some property when not (Hashtbl.mem t.broken property) ->
       Hashtbl.add t.broken property (keep_run t deep (Trail.path deep.trail @ [ Array.copy key ]))
     | Some _ | None -> ());
    let hash = hash t deep key in
    if Bitstate.is_marked deep.bits then look_for_cycle t deep key hash
    else if t.limits.max_depth <> Some depth then
      Trail.push deep.trail { state = Array.copy key; depth = depth + 1; hash }

  let rec expanding_deep t deep depth =
    let waiting = Trail.waiting deep.trail in
    let rest () =
      if t.deadlock < 0 && not (S.is_end t.system t.key.(0)) then t.deadlock <- keep t here in
    let visit key _ _ = visit_deep t deep depth key in
    match S.expand t.system (Array.copy t.key) { t.visitor with visit; rest } with
    | taken -> t.transitions <- t.transitions + taken
    | exception S.Outgrown ->
      Trail.drop_to deep.trail waiting;
      Limits.weigh t.guard ~used:(memory t) (States.bytes_to_rewrite t.states ~words:(States.words t.states + 1));
      let present = t.key in
      let renewed = widened t in
      Trail.rewrite deep.trail renewed;
      t.key <- renewed present;
      expanding_deep t deep depth

  let expand_deep t deep (entry : Trail.entry) look =
    ignore (hash t deep entry.state);
    if not (Bitstate.is_marked deep.bits) then begin
      Bitstate.mark deep.bits;
      t.depth <- max t.depth entry.depth;
      Trail.enter deep.trail entry;
      t.key <- Array.copy entry.state;
      look here;
      expanding_deep t deep entry.depth;
      if Limits.exceeds t.limits.max_states (visited deep) then raise (Limits.Stop States)
    end

  let run t ~bytes ~look ~enough =
    look_around t t.phase;
    Limits.weigh t.guard ~used:(memory t) bytes;
    Gc.full_major ();
    let runs = Hashtbl.create 8 in
    let deep = { bits = Bitstate.create ~bytes; trail = Trail.create (); runs; cycle = None } in
    t.deep <- Some deep;
    Hashtbl.add runs 0 [ 0 ];
    let initial = Array.make (States.words t.states) 0 in
    States.load t.states 0 initial;
    Trail.push deep.trail { state = initial; depth = 0; hash = hash t deep initial };
    let rec go () =
      match if enough () then None else Trail.pop deep.trail with
      | Some entry ->
        worked t;
        expand_deep t deep entry look;
        go ()
      | None -> ()
    in
    go ();
    raise (Limits.Stop Hashed)
end
