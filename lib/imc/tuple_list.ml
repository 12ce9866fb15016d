type t = (string * string) list

let pair part =
  match String.index_opt part '=' with
  | None -> (String.trim part, "")
  | Some i ->
    let rest = String.sub part (i + 1) (String.length part - i - 1) in
    (String.trim (String.sub part 0 i), String.trim rest)

let of_string s =
  let parts = String.split_on_char ';' s in
  List.filter_map (fun part -> if String.trim part = "" then None else Some (pair part)) parts

let to_string t = String.concat ";" (List.map (fun (label, value) -> label ^ "=" ^ value) t)
let find label t = List.assoc_opt label t
