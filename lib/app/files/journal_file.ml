open Dolphin_trace

let with_reader path f =
  if path = "-" then begin
    set_binary_mode_in stdin true;
    f (Journal.of_channel stdin)
  end
  else Text_file.with_channel path (fun channel -> f (Journal.of_channel channel))

let wrong path ~number why = Error.Bad_input (Printf.sprintf "%s:%d: %s" path number why)

let iter f path =
  with_reader path (fun reader ->
      let rec go () =
        match Journal.next reader with
        | Line { entry; _ } -> f entry; go ()
        | Torn _ | End_of_file -> Ok ()
        | Wrong { number; why } -> Error (wrong path ~number why)
      in
      go ())

let settings_of reader =
  match Journal.peek reader with
  | Line { entry = Header { program; _ }; _ } -> Some program.set
  | Line _ | Torn _ | End_of_file | Wrong _ -> None

(* Whether the line may be a resumption: most lines are not parsed. *)
let may_resume line =
  let word = {|"resumed"|} in
  let length = String.length word and last = String.length line in
  let rec from i =
    match String.index_from_opt line i '"' with
    | Some at when at + length <= last -> String.sub line at length = word || from (at + 1)
    | Some _ | None -> false
  in
  from 0

let resumed_with line =
  match if may_resume line then Entry.of_string line else Error "" with
  | Ok (Resumed { program; _ }) -> Some program
  | Ok _ | Error _ -> None

let rec latest channel found =
  match input_line channel with
  | exception End_of_file -> found
  | line -> latest channel (match resumed_with line with Some program -> program | None -> found)

let program path =
  let of_channel channel =
    match Journal.peek (Journal.of_channel channel) with
    | Line { entry = Header { program; _ }; _ } ->
      seek_in channel 0;
      Ok (Some (latest channel program))
    | Line _ | Torn _ | End_of_file | Wrong _ -> Ok None
  in
  Option.join (Result.to_option (Text_file.with_channel path of_channel))

let settings path = Option.map (fun (source : Header.source) -> source.set) (program path)
