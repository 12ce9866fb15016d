let ( let* ) = Option.bind

(* A slash that is escaped is a part of a name, which no file of an archive has. *)
let decoded segment =
  let* name = Dolphin_numerals.Percent_encoding.decoded segment in
  if String.exists (fun c -> c = '/' || c = '\000') name then None else Some name

let is_letter c = match c with 'a' .. 'z' | 'A' .. 'Z' -> true | _ -> false
let is_of_scheme c = is_letter c || (match c with '0' .. '9' | '+' | '-' | '.' -> true | _ -> false)

let has_scheme href =
  match String.index_opt href ':' with
  | None | Some 0 -> false
  | Some i -> is_letter href.[0] && String.for_all is_of_scheme (String.sub href 0 i)

let is_absolute href = String.starts_with ~prefix:"/" href || has_scheme href

let before c text = match String.index_opt text c with Some i -> String.sub text 0 i | None -> text

(* The path of a link from [from], with each of its segments read by [name]. *)
let resolved ~from name path =
  let step parts segment =
    let* parts = parts in
    let* segment = name segment in
    match segment, parts with
    | ("" | "."), _ -> Some parts
    | "..", _ :: above -> Some above
    | "..", [] -> None
    | segment, _ -> Some (segment :: parts)
  in
  let folder = List.tl (List.rev (String.split_on_char '/' from)) in
  let parts = List.fold_left step (Some folder) (String.split_on_char '/' path) in
  Option.map (fun parts -> String.concat "/" (List.rev parts)) parts

let targets ~from href =
  if is_absolute href then []
  else
    let path = before '#' href in
    let escaped = if String.contains path '?' then None else resolved ~from decoded path in
    let as_written = resolved ~from Option.some href in
    if escaped = as_written then Option.to_list escaped else List.filter_map Fun.id [ escaped; as_written ]
