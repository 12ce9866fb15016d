let forbidden = max_int / 4

let add a b = if a >= forbidden || b >= forbidden then forbidden else a + b

(* Narrow: by row the least cost, and by row and column the rest above it, in so many bytes. *)
type storage = Whole of int array | Narrow of { bytes : int; least : int array; above : Bytes.t }

type t = { rows : int; columns : int; storage : storage }

let of_array ~rows ~columns costs = { rows; columns; storage = Whole costs }

(* Stands for [forbidden] in 3 and in 4 bytes; rests are less. *)
let nothing_in bytes = (1 lsl (8 * bytes)) - 1

let set_rest bytes above place rest =
  if bytes = 3 then begin
    Bytes.set_uint16_ne above (3 * place) (rest land 0xFFFF);
    Bytes.set_uint8 above ((3 * place) + 2) (rest lsr 16)
  end
  else Bytes.set_int32_ne above (4 * place) (Int32.of_int rest)

let rest_in_3 above place =
  Bytes.get_uint16_ne above (3 * place) lor (Bytes.get_uint8 above ((3 * place) + 2) lsl 16)

let rest_in_4 above place = Int32.to_int (Bytes.get_int32_ne above (4 * place)) land 0xFFFF_FFFF

exception Too_wide

let narrow bytes ~rows ~columns fill =
  let nothing = nothing_in bytes in
  let least = Array.make rows 0 and above = Bytes.create (bytes * rows * columns) in
  let buffer = Array.make columns forbidden in
  for row = 0 to rows - 1 do
    fill row buffer;
    let low = Array.fold_left min forbidden buffer in
    least.(row) <- low;
    for column = 0 to columns - 1 do
      let c = buffer.(column) in
      if c < forbidden && c - low >= nothing then raise_notrace Too_wide;
      set_rest bytes above ((row * columns) + column) (if c >= forbidden then nothing else c - low)
    done
  done;
  Narrow { bytes; least; above }

let whole ~rows ~columns fill =
  let costs = Array.make (rows * columns) forbidden and buffer = Array.make columns forbidden in
  for row = 0 to rows - 1 do
    fill row buffer;
    Array.blit buffer 0 costs (row * columns) columns
  done;
  Whole costs

let make ~rows ~columns fill =
  let rec storage = function
    | bytes :: wider -> (try narrow bytes ~rows ~columns fill with Too_wide -> storage wider)
    | [] -> whole ~rows ~columns fill
  in
  { rows; columns; storage = storage [ 3; 4 ] }

let row { columns; storage; _ } row buffer =
  match storage with
  | Whole costs -> (costs, row * columns)
  | Narrow { bytes; least; above } ->
    let low = least.(row) and base = row * columns and nothing = nothing_in bytes in
    if bytes = 3 then
      for column = 0 to columns - 1 do
        let rest = rest_in_3 above (base + column) in
        buffer.(column) <- (if rest = nothing then forbidden else low + rest)
      done
    else
      for column = 0 to columns - 1 do
        let rest = rest_in_4 above (base + column) in
        buffer.(column) <- (if rest = nothing then forbidden else low + rest)
      done;
    (buffer, 0)

let dearest ({ rows; columns; _ } as costs) =
  let buffer = Array.make columns 0 and most = ref 0 in
  for number = 0 to rows - 1 do
    let array, base = row costs number buffer in
    for column = 0 to columns - 1 do
      let c = array.(base + column) in
      if c < forbidden && c > !most then most := c
    done
  done;
  !most
