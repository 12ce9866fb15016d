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

let settings path =
  let of_channel channel = Ok (settings_of (Journal.of_channel channel)) in
  Option.join (Result.to_option (Text_file.with_channel path of_channel))
