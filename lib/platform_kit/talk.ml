open Dolphin_runtime
open Dolphin_platform_protocol
open Lwt.Infix
module Order = Dolphin_platform_protocol.Order

exception Wrong of string

type t = {
  child : Child.t;
  lines : Lines.t;
  writer : Writer.t;
  mutable paused : unit Lwt.t;
  mutable resume : unit Lwt.u option;
  mutable all : Report.t list;  (* latest first *)
  mutable open_ : Report.t list;  (* those that are not accepted yet, in order *)
  mutable first : (Report.t, string) result option;
  mutable faults : string list;  (* latest first *)
  mutable said : string list;  (* latest first *)
  mutable is_over : bool;
  changed : unit Lwt_condition.t;
}

let most_said = 14
let wrong fmt = Printf.ksprintf (fun why -> Lwt.fail (Wrong why)) fmt
let excerpt text = if String.length text <= 150 then text else String.sub text 0 150 ^ "..."

let note t mark text =
  t.said <- (mark ^ " " ^ excerpt text) :: List.filteri (fun i _ -> i < most_said - 1) t.said

(* {1 Writing} *)

let send_text t text =
  note t "<" text;
  Writer.send t.writer (text ^ "\n")

let send t order = send_text t (Dolphin_json.Canonical.to_string (Order.to_json order))

(* {1 Reading} *)

let fault t why = t.faults <- why :: t.faults
let came t first = if t.first = None then t.first <- Some first

let hear t text =
  note t ">" text;
  match Report.of_line text with
  | Error why ->
    came t (Error why);
    fault t (Printf.sprintf "a line %s: %s" why (excerpt text))
  | Ok None -> came t (Error "is of a kind that the protocol does not know")
  | Ok (Some report) ->
    came t (Ok report);
    t.all <- report :: t.all;
    t.open_ <- t.open_ @ [ report ];
    (match report with
     | Note { id = Some id; _ } -> send t (Kept id)
     | Note _ | Hello _ | Trouble _ | Vehicle _ | Gone _ | Pong _ | Request _ | Checked _ | Log _ | Quiet -> ())

let rec read t =
  t.paused >>= fun () ->
  Lines.next t.lines >>= function
  | End_of_input ->
    t.is_over <- true;
    Lwt_condition.broadcast t.changed ();
    Lwt.return_unit
  | Too_long ->
    fault t "a line is too long";
    read t
  | Line text ->
    hear t text;
    Lwt_condition.broadcast t.changed ();
    read t

let start command =
  let environment = [ ("DOLPHIN_PLATFORM_PROTOCOL", string_of_int Report.version) ] in
  match Child.start ~environment command with
  | Error why -> raise (Wrong ("it cannot be started: " ^ why))
  | Ok child ->
    let t =
      { child; lines = Lines.make ~limit:Report.longest_line (Child.output child);
        writer = Writer.make (Child.input child); paused = Lwt.return_unit; resume = None; all = []; open_ = [];
        first = None; faults = []; said = []; is_over = false; changed = Lwt_condition.create () }
    in
    Lwt.async (fun () -> Lwt.catch (fun () -> read t) (fun _ -> Lwt.return_unit));
    t

let pause_reading t on =
  match on, t.resume with
  | true, None ->
    let paused, resume = Lwt.wait () in
    t.paused <- paused;
    t.resume <- Some resume
  | false, Some resume ->
    t.resume <- None;
    Lwt.wakeup_later resume ()
  | true, Some _ | false, None -> ()

(* {1 Waiting} *)

(* The first of [reports] that fits, and the others. *)
let rec pick fits before = function
  | [] -> None
  | report :: later -> (
      match fits report with
      | Some x -> Some (x, List.rev_append before later)
      | None -> pick fits (report :: before) later)

let await t ~within ~what fits =
  let late = Lwt_unix.sleep within >|= fun () -> `Late in
  let rec go () =
    match pick fits [] t.open_ with
    | Some (x, others) ->
      Lwt.cancel late;
      t.open_ <- others;
      Lwt.return x
    | None when t.is_over -> wrong "the adapter ended where %s was awaited" what
    | None -> (
        Lwt.choose [ late; (Lwt_condition.wait t.changed >|= fun () -> `Changed) ] >>= function
        | `Late -> wrong "%s did not come within %g s" what within
        | `Changed -> go ())
  in
  go ()

let reports t = List.rev t.all

let rec first_line t ~within =
  match t.first with
  | Some first -> Lwt.return first
  | None when t.is_over -> wrong "the adapter ended without a greeting"
  | None when within <= 0. -> wrong "no greeting came within 10 s"
  | None ->
    Lwt.pick [ Lwt_condition.wait t.changed; Lwt_unix.sleep 0.1 ] >>= fun () -> first_line t ~within:(within -. 0.1)

let ends_within t seconds =
  Lwt.pick [ (Child.exited t.child >|= fun _ -> true); (Lwt_unix.sleep seconds >|= fun () -> false) ]

let close_input t =
  Lwt.catch (fun () -> Lwt_unix.close (Child.input t.child)) (fun _ -> Lwt.return_unit)

let kill t = Child.kill t.child
let finish t = Child.close t.child
let faults t = List.rev t.faults
let transcript t = List.rev t.said
