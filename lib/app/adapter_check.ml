open Dolphin_semantics
open Lwt.Infix
module Process_platform = Dolphin_platform_process.Process_platform
module Plan_body = Dolphin_platform_protocol.Plan_body

type verdict = { found : Inline_plans.found; answers : (string * string list) list }

let is_fine v = List.exists (fun (_, problems) -> problems = []) v.answers
let lines v =
  let line (platform, problems) =
    match problems with
    | [] -> [ Printf.sprintf "%s: %s runs it" v.found.name platform ]
    | problems -> List.map (Printf.sprintf "%s: %s: %s" v.found.name platform) problems
  in
  let willing = List.filter (fun (_, problems) -> problems = []) v.answers in
  List.concat_map line (if willing = [] then v.answers else willing)

let task (f : Inline_plans.found) : Core.platform_task = { name = f.name; plan = f.plan; task_site = 0 }
let to_json found = Plan_body.to_json (task found)
let ( let*? ) promise f = promise >>= function Ok x -> f x | Error _ as error -> Lwt.return error

let rec each f = function
  | [] -> Lwt.return (Ok [])
  | x :: later ->
    let*? y = f x in
    let*? ys = each f later in
    Lwt.return (Ok (y :: ys))

(* A language that an adapter does not offer needs no question. *)
let problems adapter found =
  let language = Plan_body.language (task found) in
  if not (List.mem language (Process_platform.offers adapter)) then
    Lwt.return (Ok [ (if language = "name" then "it takes no plans by name" else "it takes no plans in " ^ language) ])
  else
    Process_platform.check adapter (task found)
    >|= Result.map_error (fun why ->
        Printf.sprintf "platform %s was asked about plan %s: %s" (Process_platform.platform adapter) found.name why)

let of_adapter plans taken command =
  let*? adapter = Process_platform.open_ { (Process_platform.default ~command) with purpose = Check; taken } in
  let give_up error = Process_platform.leave adapter >>= fun () -> Lwt.fail error in
  Lwt.catch (fun () -> each (problems adapter) plans) give_up >>= fun answers ->
  Process_platform.close adapter >|= fun () ->
  Result.map (fun answers -> (Process_platform.platform adapter, answers)) answers

let rec of_adapters plans answered = function
  | [] -> Lwt.return (Ok (List.rev answered))
  | command :: later ->
    let*? one = of_adapter plans (List.map fst answered) command in
    of_adapters plans (one :: answered) later

let ask interruption commands plans =
  let verdicts answered =
    let of_plan i found = { found; answers = List.map (fun (name, answers) -> (name, List.nth answers i)) answered } in
    List.mapi of_plan plans
  in
  match Lwt_main.run (Interruption.unless interruption (fun () -> of_adapters plans [] commands)) with
  | None -> Error (Error.Interrupted "interrupted before the adapters had answered")
  | Some (Ok answered) -> Ok (verdicts answered)
  | Some (Error why) -> Error (Error.Unavailable why)
