open Dolphin_semantics

type t = { states : Configuration.t array; edges : (Transition.t * int) list array }

module Table = Hashtbl.Make (Configuration)

let failure_of : Transition.awaited -> Transition.event option = function
  | End_of v -> Some (Vehicle_failed (v, "broken"))
  | Answer -> Some (Nobody_answers "end of input")
  | Reply -> Some (Host_failed "gone")
  | Answer_to (question, _) -> Some (Confirmed (question, Ok false))
  | Expiry_of _ | Recruit_for _ -> None

let success_of program : Transition.awaited -> Transition.event option = function
  | End_of v -> Some (Vehicle_done v)
  | Expiry_of timer -> Some (Timer_expired timer)
  | Answer_to (question, _) -> Some (Confirmed (question, Ok true))
  | Answer -> Result.to_option (Answer.event program Generate.answer)
  | Recruit_for _ -> None
  | Reply -> Some (Replied Null)

let outcomes ?(failures = true) ?(interruption = false) program world c =
  let awaited = Transition.awaited c in
  let events = List.filter_map (success_of program) awaited in
  let failed = if failures then List.filter_map failure_of awaited else [] in
  let recruited = List.of_seq (Transition.recruitable program world c) in
  let stopped = if interruption then [ Transition.Interruption ] else [] in
  let is_new k = not (Tuples.poll k (Integer 1) c.shared.tuples) in
  let posted = List.map (fun k -> Transition.Input (k, Integer 1)) (List.filter is_new program.Core.inputs) in
  let decided results = List.filter_map Result.to_option (Result.value results ~default:[]) in
  let accepted e = decided (Transition.accept_all program world c e) in
  let all = events @ recruited @ failed @ posted @ stopped in
  let internal = Result.value (Transition.internal_all program world c) ~default:Seq.empty in
  List.of_seq internal @ List.concat_map accepted all

exception Too_many

let explore ?(limit = 2_000) ?(failures = true) program world =
  let numbers = Table.create 256 and found = Queue.create () and count = ref 0 in
  let number c =
    match Table.find_opt numbers c with
    | Some i -> i
    | None ->
      if !count >= limit then raise Too_many;
      Table.replace numbers c !count;
      Queue.add c found;
      incr count;
      !count - 1
  in
  let rec all visited =
    match Queue.take_opt found with
    | None -> List.rev visited
    | Some c ->
      let edges = List.map (fun (t : Transition.t) -> (t, number t.next)) (outcomes ~failures program world c) in
      all ((c, edges) :: visited)
  in
  match
    ignore (number (Configuration.initial program));
    all []
  with
  | visited ->
    Some { states = Array.of_list (List.map fst visited); edges = Array.of_list (List.map snd visited) }
  | exception Too_many -> None
