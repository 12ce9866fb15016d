type t = Bytes.t

let make length = Bytes.make ((length + 7) / 8) '\000'

let add set i =
  let place = i lsr 3 in
  Bytes.set_uint8 set place (Bytes.get_uint8 set place lor (1 lsl (i land 7)))

let mem set i = Bytes.get_uint8 set (i lsr 3) land (1 lsl (i land 7)) <> 0

let rec next set i =
  if i lsr 3 >= Bytes.length set then None
  else
    let rest = Bytes.get_uint8 set (i lsr 3) lsr (i land 7) in
    if rest = 0 then next set ((i lor 7) + 1) else if rest land 1 = 1 then Some i else next set (i + 1)

let iter f set =
  for place = 0 to Bytes.length set - 1 do
    let bits = Bytes.get_uint8 set place in
    if bits <> 0 then
      for i = 0 to 7 do
        if bits land (1 lsl i) <> 0 then f ((place lsl 3) + i)
      done
  done
