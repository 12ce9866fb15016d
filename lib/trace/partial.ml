open Dolphin_semantics
module Seen = Hashtbl.Make (Configuration)

type t = {
  program : Core.program;
  world : World.t;
  observed : string list;
  most : int;
  ways : Configuration.t list;  (* all that the lines so far may have led to, each once *)
  lines : int;
  over : bool;
}

type mismatch = { reason : string; possible : string list }
type trouble = Impossible of mismatch | Too_many

let start ~observed ~most world program =
  { program; world; observed; most; ways = [ Configuration.initial program ]; lines = 0; over = false }

let lines p = p.lines
let is_over p = p.over

let kind label =
  let stop = ref (String.length label) in
  String.iteri (fun i c -> if (c = '(' || c = ' ') && i < !stop then stop := i) label;
  String.sub label 0 !stop

let show (t : Transition.t) = Format.asprintf "%a" Label.pp t.label
let is_hidden p label = p.observed <> [] && not (List.mem (kind label) p.observed)

(* {1 Steps} *)

(* The part after [prefix] in [label], less its closing parenthesis. *)
let inside prefix label =
  let n = String.length prefix and length = String.length label in
  let fits = length > n && String.sub label 0 n = prefix && label.[length - 1] = ')' in
  if fits then Some (String.sub label n (length - n - 1)) else None

(* The value that [text] is as an answer to a question. *)
let value_of p text =
  let start = Configuration.initial p.program in
  let answered event =
    match start.control with
    | Script m -> (
        let c = { start with control = Waiting (m, Ask "") } in
        match Transition.accept p.program p.world c event with
        | Ok { next = { control = Script { focus = Give x; _ }; _ }; _ } -> Some x
        | Ok _ | Error _ -> None)
    | Waiting _ | Executing _ | Ended _ -> None
  in
  Option.bind (Result.to_option (Answer.event p.program text)) answered

(* The input in [label]. *)
let input p label : Transition.event option =
  let of_key key =
    let prefix = Printf.sprintf "input %s:" key in
    let n = String.length prefix in
    if String.length label <= n || String.sub label 0 n <> prefix then None
    else
      let text = String.sub label n (String.length label - n) in
      Option.map (fun x -> Transition.Input (key, x)) (value_of p text)
  in
  List.find_map of_key p.program.inputs

(* The events that may make a transition of [c] with this label; without, those that may have been hidden. *)
let events p (c : Configuration.t) label =
  let ends v =
    let name = match Vehicle_map.find_opt v c.shared.allocation with Some task -> task.name | None -> "" in
    match label with
    | None when is_hidden p "fail" -> [ Transition.Vehicle_done v; Vehicle_failed (v, "failed") ]
    | None -> [ Vehicle_done v ]
    | Some label -> (
        match inside (Printf.sprintf "fail(%s, %s, " v name) label with
        | Some why -> [ Vehicle_failed (v, why) ]
        | None -> [ Vehicle_done v ])
  in
  let of_awaited : Transition.awaited -> Transition.event list = function
    | End_of v -> ends v
    | Expiry_of timer -> [ Timer_expired timer ]
    | Answer_to (question, _) -> (
        match label with
        | Some "no-answer" -> [ Confirmed (question, Error "") ]
        | Some label ->
          let yes = Option.bind (inside "answer(" label) Answer.confirmation in
          Option.to_list (Option.map (fun yes -> Transition.Confirmed (question, Ok yes)) yes)
        | None -> [ Confirmed (question, Ok true); Confirmed (question, Ok false) ])
    | Recruit_for (number, _) -> (
        match Option.map (inside "recruit(") label with
        | Some (Some v) -> [ Recruited (number, v) ]
        | Some None -> []
        | None ->
          let is_it : Transition.event -> bool = function Recruited (i, _) -> i = number | _ -> false in
          List.of_seq (Seq.filter is_it (Transition.recruitable p.program p.world c)))
    | Answer -> (
        match label with
        | None -> []
        | Some "no-answer" -> [ Nobody_answers "" ]
        | Some label -> 
          let answered text = Result.to_option (Answer.event p.program text) in
          Option.to_list (Option.bind (inside "answer(" label) answered))
    | Reply -> (
        match label with
        | None -> []
        | Some label -> Option.to_list (Option.map (fun why -> Transition.Host_failed why) (inside "no-reply(" label)))
  in
  let interruption = if label = Some "interrupt" then [ Transition.Interruption ] else [] in
  let posted = Option.to_list (Option.bind label (input p)) in
  List.concat_map of_awaited (Transition.awaited c) @ posted @ interruption

exception Enough

(* When what is hidden happened is not known. A dependence on more than a comparison of the date cannot be judged. *)
let undated p = if p.program.reads_now then { p with world = World.at Any p.world } else p
let dated time p = if p.program.reads_now then { p with world = World.at (Exactly (World.whole time)) p.world } else p
let told = function Ok x -> x | Error (_ : Fault.t) -> raise Enough

let on p c event =
  if p.program.reads_now then
    List.filter_map Result.to_option (told (Transition.accept_all p.program p.world c event))
  else Option.to_list (Result.to_option (Transition.accept p.program p.world c event))

let internal p c =
  if p.program.reads_now then told (Transition.internal_all p.program p.world c)
  else Transition.internal p.program p.world c

let steps p c label : Transition.t Seq.t =
  let p = if label = None then undated p else p in
  let caused () = List.to_seq (List.concat_map (on p c) (events p c label)) () in
  Seq.append (internal p c) caused

(* {1 Search} *)

(* [f] of each configuration that hidden steps lead to, breadth first, each once. *)
let each_way p f =
  let seen = Seen.create 64 and queue = Queue.create () in
  let reach c =
    if not (Seen.mem seen c) then begin
      if Seen.length seen >= p.most then raise Enough;
      Seen.replace seen c ();
      Queue.add c queue
    end
  in
  List.iter reach p.ways;
  while not (Queue.is_empty queue) do
    let c = Queue.take queue in
    f c;
    Seq.iter (fun (t : Transition.t) -> if is_hidden p (show t) then reach t.next) (steps p c None)
  done

let most_shown = 8

(* [after p choose what] is all that [choose] makes of the configurations that are possible now. *)
let after p choose what =
  let found = Seen.create 64 and ways = ref [] and possible = ref [] in
  let add c =
    if not (Seen.mem found c) then begin
      Seen.replace found c ();
      ways := c :: !ways
    end
  in
  let note c =
    if List.length !possible < most_shown then
      Seq.iter
        (fun t ->
           let label = show t in
           if (not (is_hidden p label)) && not (List.mem label !possible) then possible := label :: !possible)
        (steps p c None)
  in
  match each_way p (fun c -> choose c add; if !ways = [] then note c) with
  | exception Enough -> Error Too_many
  | () ->
    if !ways <> [] then Ok { p with ways = List.rev !ways; lines = p.lines + 1 }
    else Error (Impossible { reason = what ^ " could not happen"; possible = List.rev !possible })

let label p text =
  let choose c add =
    Seq.iter (fun (t : Transition.t) -> if show t = text then add t.next) (steps p c (Some text))
  in
  if is_hidden p text then
    let reason = Printf.sprintf "labels like %s are not among those that this trace has" text in
    Error (Impossible { reason; possible = [] })
  else after p choose text

let cause p event =
  let choose (c : Configuration.t) add =
    match Event.to_event p.program c event with
    | Ok cause -> List.iter (fun (t : Transition.t) -> add t.next) (on p c cause)
    | Error _ -> ()
  in
  after p choose (Format.asprintf "%a" Event.pp event)

let finish p (ending : Request.ending) =
  (* The words of a failure that is hidden are not known. *)
  let failed (e : Request.ending) = e.how = "failed" in
  let same its = its = ending || (is_hidden p "fail" && failed its && failed ending) in
  let choose (c : Configuration.t) add =
    match c.control with
    | Ended its_ending when same (Request.ending its_ending) -> add c
    | Ended Interrupted when ending.how = "stuck" -> add c
    | Script _ | Waiting _ | Executing _ | Ended _ -> ()
  in
  let what = Printf.sprintf "a run that ended %s" ending.how in
  Result.map (fun p -> { p with over = true; lines = p.lines - 1 }) (after p choose what)

(* Hidden events may have occurred before this was known, or will after. *)
let see p (state : World.vehicle_state) =
  if World.find state.id p.world = Some state then Ok p
  else
    let ways = ref [] in
    match each_way p (fun c -> ways := c :: !ways) with
    | exception Enough -> Error Too_many
    | () -> Ok { p with ways = List.rev !ways; world = World.add state p.world }

let feed p (entry : Entry.t) =
  if p.over then Error (Impossible { reason = "the trace goes on after its last line"; possible = [] })
  else
    let p = match entry with Header _ | Partial _ -> p | entry -> dated (Entry.time entry) p in
    match entry with
    | Vehicle { state; _ } -> see p state
    | Label { label = text; _ } -> label p text
    | Event { event; _ } -> cause p event
    | End { ending; _ } -> finish p ending
    | Header _ | Partial _ | Note _ | Act _ | Resumed _ -> Ok p
    | Transition _ -> Error (Impossible { reason = "transitions are lines of whole journals"; possible = [] })
