let closed ?(most = max_int) ~equal round start =
  let rec cycle after found = function
    | (s, steps) :: earlier when equal s after -> Some (List.concat_map snd (List.rev earlier), steps @ found)
    | (_, steps) :: earlier -> cycle after (steps @ found) earlier
    | [] -> None
  in
  (* [rounds] has where each began, latest first. *)
  let rec go rounds s left =
    match if left = 0 then None else round s with
    | None -> None
    | Some (next, steps) -> (
        let rounds = (s, steps) :: rounds in
        match cycle next [] rounds with
        | Some _ as found -> found
        | None -> go rounds next (left - 1))
  in
  go [] start most
