(* The limit on expressions that are evaluated in one silent transition of the script. *)
let fuel = 10_000

let rule_of_deed : Code.deed -> Rule.t = function
  | Posted _ -> Post
  | Consumed _ -> Consume
  | Said _ -> Message
  | Released _ -> Release
  | Set_connection_timeout _ -> Set_timeout

(* No task runs while the script does, so to release a vehicle stops none. *)
let do_deed (deed : Code.deed) s m =
  Conclusion.make ~effects:(Run_code.effects [ deed ]) (rule_of_deed deed) (Did deed) (Script m) s

let rec from n () = Seq.Cons (n, from (n + 1))

let execute program world (s : Shared.t) m t =
  let allocated = function
    | Error (fault : Fault.t) ->
      let fault = if fault.site = Fault.unknown_site then { fault with site = Machine.site m } else fault in
      Conclusion.ending [ Alloc_err ] (Cannot_execute fault.message) s (Failed fault)
    | Ok r ->
      let r, begun = Residual.activate r in
      let keys = List.filter_map (function Residual.Key n -> Some (Residual.key n) | Wait _ -> None) begun in
      Conclusion.make ~effects:(Conclusion.begun begun) Execute Execute (Executing (m, r)) (Shared.without_keys keys s)
  in
  let opened = function
    | _, Error fault -> Decision.Decided (allocated (Error fault))
    | world, Ok opened ->
      Decision.map allocated (Decision.look world (fun world -> Allocation.allocate world s.bound opened t))
  in
  Decision.bind (Maker.opened program world s ~numbers:(from 1) ~depth:0 t) opened

let wait program world s m (request : Code.request) =
  let waiting rule label action =
    Decision.Decided (Conclusion.make ~effects:[ action ] rule label (Waiting (m, request)) s)
  in
  match request with
  | Execute t -> execute program world s m t
  | Pick pick -> waiting Pick (Pick (Format.asprintf "%a" Settings.pp_pick pick)) (Look_for pick)
  | Ask prompt -> waiting Ask (Ask prompt) (Ask prompt)
  | Pause seconds -> waiting Pause (Pause seconds) (Set_timer (Residual.script_timer, seconds))
  | Host_call { subject; member; arguments } ->
    waiting Call (Call (Machine.name_of_call ~subject ~member)) (Call_host { subject; member; arguments })

let keep_in_machine world m = if World.is_open world then Machine.keep_readings m else m

let step program world s m =
  let stopped ((stop : Machine.stop), m, (context : Code.context)) =
    let m = keep_in_machine world m and s = Run_code.kept program world (Run_code.after context s) in
    match stop with
    | Exhausted -> Decision.Decided (Conclusion.make Script Silent (Script m) s)
    | Did deed -> Decided (do_deed deed s m)
    | Waits request -> wait program context.world s m request
    | Finished _ -> Decided (Conclusion.ending [ End ] End s Completed)
    | Left_off -> Decided (Conclusion.ending [ End ] End s Interrupted)
    | Halted message -> Decided (Conclusion.ending [ Halt ] (Halt message) s (Halted message))
    | Faulted fault -> Decided (Conclusion.ending [ Fault ] (Fault fault.message) s (Failed fault))
  in
  Decision.bind (Machine.run ~fuel (Run_code.context program world s Script) m) stopped

let on_interrupt ?(recruits = []) (program : Core.program) (s : Shared.t) m : Configuration.t option =
  let bound = s.bound @ recruits in
  match program.on_interrupt with
  | Some lambda when bound <> [] && not (Machine.is_leaving m) ->
    let m = Machine.call { lambda; captured = [||] } [ Vehicles bound ] in
    Some { control = Script m; shared = Shared.without_fresh { s with allocation = Vehicle_map.empty; bound } }
  | Some _ | None -> None

let interrupt program (c : Configuration.t) m =
  let waits = Configuration.waits c and recruits = Configuration.recruits c in
  let s = match c.control with Executing (_, r) -> Shared.ensure (Residual.ensured r) c.shared | _ -> c.shared in
  match on_interrupt ~recruits program s m with
  | Some { control; shared } ->
    Conclusion.make ~effects:(Conclusion.cut waits s) On_interrupt Interrupt control shared
  | None -> Conclusion.ending ~waits ~recruits [ Interrupt ] Interrupt s Interrupted

let go_on rule label x s m = Conclusion.make rule label (Script (Machine.give x m)) s

let fail rule label why s m = Conclusion.ending [ rule ] label s (Failed (Fault.make (Machine.site m) why))

let answer program world (s : Shared.t) m ~text code =
  let ran { Run_code.outcome; _ } =
    match outcome with
    | Gives (x, after, []) when Store.compare after.store s.store = 0 ->
      Ok (Conclusion.make Answer (Answer text) (Script (keep_in_machine world (Machine.give x m))) s)
    | Gives _ | Halts _ -> Error "an answer may only compute a value"
    | Faulty (fault, _) -> Error fault.message
  in
  Decision.map ran (Run_code.atomic program world s code)
