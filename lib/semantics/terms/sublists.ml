let of_length n xs =
  let rec from n xs length () =
    match xs with
    | _ when n = 0 -> Seq.return [] ()
    | x :: rest when n <= length ->
      let chosen = Seq.map (fun chosen -> x :: chosen) (from (n - 1) rest (length - 1)) in
      Seq.append chosen (from n rest (length - 1)) ()
    | _ -> Seq.Nil
  in
  from n xs (List.length xs)
