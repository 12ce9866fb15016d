type severity = Error | Warning

type code =
  | Syntax
  | Unknown_name | Unknown_unit | Unknown_setting | Unknown_argument
  | Wrong_arity | Wrong_kind | Wrong_value | Wrong_parameters | No_pairs | No_value
  | Waits_in_task | Handler_only
  | Captured_local | Not_assignable | Defined_twice | Reserved_name
  | Wildcard_value
  | Misplaced_jump | Misplaced_when | Misplaced_setting | Misplaced_function | Misplaced_input
  | Misplaced_parameter | Misplaced_interrupt
  | Bad_map | Bad_fence | Broken_fence | No_place | No_way | Deed_in_answer
  | Deed_in_maker
  | Vehicle_twice
  | Unused_task | No_effect | Assigned_condition | Never_holds | Wide_value | Unknown_plan | Unread_input
  | Other_meaning | Partial_map | No_end | No_time | Ends_here

let codes =
  [ (Syntax, "syntax"); (Unknown_name, "unknown-name"); (Unknown_unit, "unknown-unit");
    (Unknown_setting, "unknown-setting"); (Unknown_argument, "unknown-argument"); (Wrong_arity, "wrong-arity");
    (Wrong_kind, "wrong-kind"); (Wrong_value, "wrong-value");
    (Wrong_parameters, "wrong-parameters"); (No_pairs, "no-pairs"); (No_value, "no-value");
    (Waits_in_task, "waits-in-task"); (Handler_only, "handler-only"); (Captured_local, "captured-local");
    (Not_assignable, "not-assignable"); (Defined_twice, "defined-twice"); (Reserved_name, "reserved-name");
    (Wildcard_value, "wildcard-value"); (Misplaced_jump, "misplaced-jump"); (Misplaced_when, "misplaced-when");
    (Misplaced_setting, "misplaced-setting"); (Misplaced_function, "misplaced-function");
    (Misplaced_input, "misplaced-input"); (Misplaced_parameter, "misplaced-parameter");
    (Misplaced_interrupt, "misplaced-on-interrupt");
    (Bad_map, "bad-map"); (Bad_fence, "bad-fence"); (Broken_fence, "broken-fence"); (No_place, "no-place");
    (No_way, "no-way");
    (Deed_in_answer, "deed-in-answer"); (Deed_in_maker, "deed-in-maker");
    (Vehicle_twice, "vehicle-twice"); (Unused_task, "unused-task");
    (No_effect, "no-effect"); (Assigned_condition, "assigned-condition"); (Never_holds, "never-holds");
    (Wide_value, "wide-value"); (Unknown_plan, "unknown-plan"); (Unread_input, "unread-input");
    (Other_meaning, "other-meaning"); (Partial_map, "partial-map"); (No_end, "no-end"); (No_time, "no-time");
    (Ends_here, "ends-here") ]

let code_name code = List.assoc code codes

type t = { at : Location.t; message : string; hint : string option; severity : severity; code : code }

let error ?hint ?(code = Syntax) at message = { at; message; hint; severity = Error; code }
let warning ?hint code at message = { at; message; hint; severity = Warning; code }

let offset d = d.at.Location.start.Lexing.pos_cnum

let compare a b =
  match Int.compare (offset a) (offset b) with
  | 0 -> String.compare a.message b.message
  | order -> order

(* {1 The line a diagnostic points at} *)

(* The characters of [source] from [first] up to [last], each as it is shown: one column each, but for a
   tab, which takes four. *)
let shown source first last =
  let rec characters i reversed =
    if i >= last then List.rev reversed
    else
      let next = min last (i + max 1 (Character.length source i)) in
      let cell =
        match source.[i] with
        | '\t' -> "    "
        | '\r' -> ""
        | _ -> Character.printable (String.sub source i (next - i))
      in
      characters next (cell :: reversed)
  in
  characters first []

let columns cells =
  List.fold_left (fun n cell -> if cell = "    " then n + 4 else if cell = "" then n else n + 1) 0 cells

let rec drop n = function
  | _ :: rest when n > 0 -> drop (n - 1) rest
  | rest -> rest

let take n cells =
  let rec go n reversed = function
    | cell :: rest when n > 0 -> go (n - 1) (cell :: reversed) rest
    | _ -> List.rev reversed
  in
  go n [] cells

(* How much of a long line is shown: in all, and before the caret. *)
let width = 110
let lead = 50

(* The beginning and end of the line with byte [at]. *)
let line_bounds source at =
  let first = match String.rindex_from_opt source (at - 1) '\n' with Some i -> i + 1 | None -> 0 in
  let last = match String.index_from_opt source at '\n' with Some i -> i | None -> String.length source in
  first, last

let pp_line source ppf at =
  let { Location.start; stop } = at in
  let here = max 0 (min start.Lexing.pos_cnum (String.length source)) in
  let first, last = line_bounds source here in
  (* Only what is near the caret is ever looked at: a line may have a megabyte. *)
  let near = 4 * (width + lead) in
  let before_first = max first (here - near) in
  let before = shown source before_first here in
  let marked = shown source here (min last (min (here + near) (max here stop.Lexing.pos_cnum))) in
  let stops = max here stop.Lexing.pos_cnum in
  let after = shown source (min last stops) (min last (stops + near)) in
  let is_wide = List.length before + List.length marked + List.length after > width in
  let cut_before = before_first > first || (is_wide && List.length before > lead) in
  let before = if cut_before then drop (List.length before - lead) before else before in
  let room = max 1 (width - List.length before) in
  let marked' = take room marked in
  let after' = take (room - List.length marked') after in
  let cut_after =
    List.length marked' < List.length marked || List.length after' < List.length after || last - here > 3 * near in
  let number = string_of_int (Location.line at) in
  let gutter = String.make (String.length number) ' ' in
  let before_width = columns before + if cut_before then 3 else 0 in
  Format.fprintf ppf "@\n  %s | %s%s%s%s%s" number (if cut_before then "..." else "") (String.concat "" before)
    (String.concat "" marked') (String.concat "" after') (if cut_after then "..." else "");
  Format.fprintf ppf "@\n  %s | %s%s" gutter (String.make before_width ' ') (String.make (max 1 (columns marked')) '^')

let pp ~source ppf d =
  let word = match d.severity with Error -> "error" | Warning -> "warning" in
  let placed = d.at <> Location.none in
  if placed then Format.fprintf ppf "%s: " (Character.printable (Format.asprintf "%a" Location.pp d.at));
  Format.fprintf ppf "%s: %s" word (Character.printable d.message);
  if placed then pp_line source ppf d.at;
  match d.hint with
  | None -> ()
  | Some hint ->
    let indent = if placed then 3 + String.length (string_of_int (Location.line d.at)) else 2 in
    Format.fprintf ppf "@\n%shint: %s" (String.make indent ' ') (Character.printable hint)

(* {1 Did you mean} *)

(* The Damerau-Levenshtein distance (neighbours may be swapped). *)
let distance a b =
  let m = String.length a and n = String.length b in
  let d = Array.make_matrix (m + 1) (n + 1) 0 in
  for i = 0 to m do d.(i).(0) <- i done;
  for j = 0 to n do d.(0).(j) <- j done;
  for i = 1 to m do
    for j = 1 to n do
      let cost = if a.[i - 1] = b.[j - 1] then 0 else 1 in
      d.(i).(j) <- min (min (d.(i - 1).(j) + 1) (d.(i).(j - 1) + 1)) (d.(i - 1).(j - 1) + cost);
      if i > 1 && j > 1 && a.[i - 1] = b.[j - 2] && a.[i - 2] = b.[j - 1] then
        d.(i).(j) <- min d.(i).(j) (d.(i - 2).(j - 2) + 1)
    done
  done;
  d.(m).(n)

let suggest x xs =
  let length = String.length x in
  if length > 64 then None
  else
    let bound = if length <= 3 then 1 else if length <= 5 then 2 else 3 in
    let lower = String.lowercase_ascii x in
    let nearer best candidate =
      if candidate = x || abs (String.length candidate - length) > bound then best
      else
        let found = distance lower (String.lowercase_ascii candidate) in
        (* Words with nothing in common but the length are not misspellings. *)
        if found > bound || found >= length then best
        else
          match best with
          | Some (least, _) when least <= found -> best
          | Some _ | None -> Some (found, candidate)
    in
    Option.map snd (List.fold_left nearer None xs)
