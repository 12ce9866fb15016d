type lasso = { stem : int list; around : int list }

(* Depth first with a stack of its own. A state is new, on the path, or done. *)
let state_on_cycle ~interrupted space =
  let marks = Bytes.make (Space.count space) '\000' in
  let stack = Stack.create () in
  let enter i =
    Bytes.set marks i '\001';
    Stack.push (i, ref (Space.successors space i)) stack
  in
  let steps = ref 0 in
  let rec go () =
    incr steps;
    if !steps land 0xFFFF = 0 && interrupted () then raise Exit;
    match Stack.top_opt stack with
    | None -> None
    | Some (i, successors) -> (
        match !successors with
        | [] ->
          Bytes.set marks i '\002';
          ignore (Stack.pop stack);
          go ()
        | j :: rest -> (
            successors := rest;
            match Bytes.get marks j with
            | '\000' ->
              enter j;
              go ()
            | '\001' -> Some j
            | _ -> go ()))
  in
  enter 0;
  go ()

let shortest_around space start =
  let from = Hashtbl.create 1_000 and queue = Queue.create () in
  let rec back i states = if i = start then start :: states else back (Hashtbl.find from i) (i :: states) in
  let rec go () =
    let i = Queue.take queue in
    let successors = Space.successors space i in
    if List.mem start successors then back i [ start ]
    else begin
      let add j =
        if not (Hashtbl.mem from j) then begin
          Hashtbl.add from j i;
          Queue.add j queue
        end
      in
      List.iter add successors;
      go ()
    end
  in
  Queue.add start queue;
  go ()

let find ~interrupted space =
  if not (Space.may_cycle space) then None
  else
    (* Where states stand for others, the run need not come back to the very one that it left; it does to those of the
       script, which stand for themselves. *)
    let is_exact i = match Space.view space i with Exact _ -> true | Up_to _ -> false in
    let exact i = if is_exact i then i else List.find is_exact (shortest_around space i) in
    let lasso i =
      let start = exact i in
      { stem = Replay.shortest space start; around = shortest_around space start }
    in
    Option.map lasso (state_on_cycle ~interrupted space)
