type t = { file : string; mutation : Mutation.t }

let rec files_below folder =
  let below name =
    let path = Filename.concat folder name in
    if Sys.is_directory path then files_below path else if Filename.check_suffix name ".ml" then [ path ] else []
  in
  let names = Sys.readdir folder in
  Array.sort String.compare names;
  List.concat_map below (Array.to_list names)

let of_file file = List.map (fun mutation -> { file; mutation }) (Mutation.all (Working_copy.read file))

(* Places by folder, then by kind. A folder is read when the first mistake in it is drawn. *)
let by_kind is_wanted (row : Judges.t) =
  lazy
    (let is_own file = is_wanted file && Judges.of_file file = Some row in
     let places = List.concat_map of_file (List.filter is_own (files_below row.folder)) in
     let of_kind kind = List.filter (fun place -> place.mutation.kind = kind) places in
     Array.of_list (List.filter (( <> ) []) (List.map of_kind Mutation.kinds)) |> Array.map Array.of_list)

let pick random xs = xs.(Random.State.int random (Array.length xs))

let draw ~seed ~count ~is_wanted =
  let random = Random.State.make [| seed |] in
  let places row = (row, by_kind is_wanted row) in
  let weighted ((row : Judges.t), places) = List.init row.weight (fun _ -> places) in
  let folders = Array.of_list (List.concat_map weighted (List.map places Judges.all)) in
  let taken = Hashtbl.create 64 in
  let rec more n tries =
    if n = 0 || tries = 0 then []
    else
      let kinds = Lazy.force (pick random folders) in
      let drawn = if kinds = [||] then None else Some (pick random (pick random kinds)) in
      match drawn with
      | Some place when not (Hashtbl.mem taken place) ->
        Hashtbl.add taken place ();
        place :: more (n - 1) tries
      | Some _ | None -> more n (tries - 1)
  in
  more count (1000 + (100 * count))

let at place =
  match String.split_on_char ':' place with
  | [ file; line ] ->
    List.filter (fun d -> Some d.mutation.line = int_of_string_opt line) (of_file file)
  | _ -> of_file place
