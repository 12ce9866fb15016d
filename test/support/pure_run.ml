(* Runs of programs without any platform: every event that is awaited may come at once. *)

open Dolphin_semantics

let read ~file source =
  let nobody path = Error (path ^ ": there are no other files") in
  snd (Dolphin_syntax.Include.program ~read:nobody ~file source)

let compile ?place source =
  match read ~file:"test.dol" source with
  | Error ds -> Error ds
  | Ok ast -> Result.map fst (Elaborate.program_at ~place ~source_name:"test.dol" ast)

let explain source ds = Format.asprintf "%a" (Fmt.list (Dolphin_syntax.Diagnostic.pp ~source)) ds

let compile_exn ?place source =
  match compile ?place source with Ok program -> program | Error ds -> failwith (explain source ds)

let vehicle ?(kind = "UUV") ?(payload = [ "DVL"; "Sidescan"; "Camera" ]) ?(battery = 1.) ?(north = 0.) ?(readings = []) id =
  let position = Dolphin_geo.Wgs84.displace Dolphin_geo.Place.apdl ~north ~east:0. in
  { World.id; kind; payload; position; battery = Some battery; speed = Some 0.; readings; connected = true;
    unready = None; cruise = None; drain = None; progress = []; depth = None; altitude = None }

let world vehicles = List.fold_left (fun w v -> World.add v w) World.empty vehicles

let fleet =
  world
    [ vehicle "noptilus-1"; vehicle "noptilus-2" ~north:100.; vehicle "noptilus-3" ~north:200.;
      vehicle "x8-02" ~kind:"UAV" ~north:300. ]

(* The successors by the events that [c] awaits, one after the other. *)
let awaited ?(answers = []) program world c =
  let event : Transition.awaited -> (Transition.event, _) result = function
    | End_of v -> Ok (Vehicle_done v)
    | Expiry_of timer -> Ok (Timer_expired timer)
    | Answer_to (question, _) -> Ok (Confirmed (question, Ok true))
    | Answer -> Answer.event program (match answers with text :: _ -> text | [] -> "")
    | Recruit_for _ -> Error Transition.Not_awaited
    | Reply -> Ok (Replied Null)
  in
  let follow awaited = Result.to_option (Result.bind (event awaited) (Transition.accept program world c)) in
  let recruited () =
    match Transition.recruited program world c with Some (_, t) -> Seq.return t () | None -> Seq.Nil
  in
  Seq.append recruited (Seq.filter_map follow (List.to_seq (Transition.awaited c)))

let successors ?answers program world c =
  (List.of_seq (Transition.internal program world c), List.of_seq (awaited ?answers program world c))

let first (steps : Transition.t Seq.t) = match steps () with Seq.Nil -> None | Cons (t, _) -> Some t

(* A run in which the program's own steps come first, then the first event that is awaited. *)
let run ?(limit = 10_000) ?(answers = []) ?(world = fleet) program =
  let rec go n answers c trace =
    let next =
      if n = 0 then None
      else
        match first (Transition.internal program world c) with
        | Some t -> Some t
        | None -> first (awaited ~answers program world c)
    in
    match next with
    | None -> List.rev trace
    | Some t ->
      let answers = match t.label, answers with Answer _, _ :: rest -> rest | _, answers -> answers in
      go (n - 1) answers t.next (t :: trace)
  in
  go limit answers (Configuration.initial program) []

let labels trace = List.map (fun (t : Transition.t) -> Format.asprintf "%a" Label.pp t.label) trace

let last trace = match List.rev trace with [] -> None | (t : Transition.t) :: _ -> Some t.next

let rules (t : Transition.t) = String.concat ", " (List.map Rule.name t.rules)

let said trace =
  let of_effect (e : Effect.t) =
    match e with
    | Say text -> Some text
    | Start _ | Stop _ | Set_timer _ | Cancel_timer _ | Put_question _ | Withdraw_question _ | Look_for _ | Bind _
    | Release _ | Set_connection_timeout _ | Ask _ | Call_host _ | End _ -> None
  in
  List.concat_map (fun (t : Transition.t) -> List.filter_map of_effect t.effects) trace

let ending trace =
  match last trace with
  | Some { control = Ended Completed; _ } -> "completed"
  | Some { control = Ended (Halted message); _ } -> "halted: " ^ message
  | Some { control = Ended (Failed fault); _ } -> "failed: " ^ fault.message
  | Some { control = Ended Interrupted; _ } -> "interrupted"
  | Some { control = Script _ | Waiting _ | Executing _; _ } | None -> "goes on"
