open Bigarray

type t = (int32, int32_elt, c_layout) Array1.t

let limit = Int32.to_int Int32.max_int

let make n : t =
  let vector = Array1.create Int32 C_layout n in
  Array1.fill vector 0l;
  vector

let length (vector : t) = Array1.dim vector
let get (vector : t) i = Int32.to_int vector.{i}
let set (vector : t) i x = vector.{i} <- Int32.of_int x

let order_by key ~keys vector =
  let starts = make (keys + 1) in
  for i = 0 to length vector - 1 do
    let k = key (get vector i) in
    set starts (k + 1) (get starts (k + 1) + 1)
  done;
  for k = 1 to keys do
    set starts k (get starts k + get starts (k - 1))
  done;
  let ordered = make (length vector) in
  for i = 0 to length vector - 1 do
    let x = get vector i in
    let k = key x in
    set ordered (get starts k) x;
    set starts k (get starts k + 1)
  done;
  ordered

module Growing = struct
  type vector = t
  type t = { mutable elements : vector; mutable length : int }

  let create () = { elements = make 16; length = 0 }
  let length growing = growing.length

  let add growing x =
    let room = Array1.dim growing.elements in
    if growing.length = room then begin
      let larger = make (2 * room) in
      Array1.blit growing.elements (Array1.sub larger 0 room);
      growing.elements <- larger
    end;
    set growing.elements growing.length x;
    growing.length <- growing.length + 1

  let contents growing = Array1.sub growing.elements 0 growing.length
end
