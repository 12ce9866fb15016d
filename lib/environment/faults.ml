type limit = Never | At_most of int | Any_number

type t = { fail : limit; loss : limit; join : limit; interrupt : bool }

let is_possible = function Never | At_most 0 -> false | At_most _ | Any_number -> true
let none = { fail = Never; loss = Never; join = Never; interrupt = false }
let all = { fail = Any_number; loss = Any_number; join = Any_number; interrupt = false }
let names = [ "fail"; "loss"; "join"; "all"; "interrupt" ]

(* To interrupt is a person's decision and no fault: it is not among [all]. *)
let set faults name limit =
  match name with
  | "fail" -> Ok { faults with fail = limit }
  | "loss" -> Ok { faults with loss = limit }
  | "join" -> Ok { faults with join = limit }
  | "all" -> Ok { faults with fail = limit; loss = limit; join = limit }
  | "interrupt" -> Ok { faults with interrupt = limit <> At_most 0 }
  | other ->
    let hint =
      match Dolphin_syntax.Diagnostic.suggest other names with
      | Some near -> Printf.sprintf "did you mean %s?" near
      | None -> "there are fail, loss, join, all and interrupt"
    in
    Error (Printf.sprintf "unknown fault '%s': %s" other hint)

let add faults item =
  Result.bind faults (fun faults ->
      match String.split_on_char '=' item with
      | [ name ] -> set faults name Any_number
      | [ name; n ] -> (
          match int_of_string_opt n with
          | Some n when n >= 0 -> set faults name (At_most n)
          | Some _ | None -> Error (Printf.sprintf "'%s' is not a number of faults, as in %s=1" n name))
      | _ -> Error (Printf.sprintf "'%s' is not as in fail or fail=1" item))

let of_string text = List.fold_left add (Ok none) (String.split_on_char ',' text)

let pp ppf faults =
  let item (name, limit) =
    match limit with
    | Never -> None
    | At_most n -> Some (Printf.sprintf "%s=%d" name n)
    | Any_number -> Some name
  in
  let items = [ ("fail", faults.fail); ("loss", faults.loss); ("join", faults.join) ] in
  let interrupt = if faults.interrupt then [ "interrupt" ] else [] in
  Format.pp_print_string ppf (String.concat "," (List.filter_map item items @ interrupt))
