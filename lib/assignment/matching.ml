let forbidden = Costs.forbidden

type t = {
  column_of : int array;
  row_of : int array;  (* by column, -1 for none *)
  dual : int array;  (* by column: not positive, 0 for columns without row *)
}

(* A square matrix: the rows of the given one, and below them rows that cost nothing anywhere, which hold the columns
   that are free in the end. *)
type square = { costs : Costs.t; columns : int; buffer : int array; nothing : int array }

let square (costs : Costs.t) =
  let columns = costs.columns in
  { costs; columns; buffer = Array.make columns 0; nothing = Array.make columns 0 }

(* The array that has a row of the matrix, and the beginning of the row in it, until the next row is asked for. *)
let row_in m row = if row < m.costs.rows then Costs.row m.costs row m.buffer else (m.nothing, 0)

(* Each row that has one takes a free column among its cheapest: so dear searches start from few rows only. *)
let take_cheapest m ~rows dual column_of row_of =
  for row = 0 to rows - 1 do
    let cost, base = row_in m row in
    let least = ref forbidden and choice = ref (-1) in
    for column = 0 to m.columns - 1 do
      let c = cost.(base + column) in
      if c < forbidden then begin
        let c = c - dual.(column) in
        if c < !least then begin
          least := c;
          choice := if row_of.(column) < 0 then column else -1
        end
        else if c = !least && !choice < 0 && row_of.(column) < 0 then choice := column
      end
    done;
    if !choice >= 0 then begin
      column_of.(row) <- !choice;
      row_of.(!choice) <- row
    end
  done

(* {1 Duals to start from}

   An auction with steps that become smaller, after Bertsekas (1988): a row bids for its cheapest column as much as
   it would cost to take the second cheapest, and a step more. The duals are those of a matching that is at most a
   step for each row dearer than the best; the searches below close the gap to the best. *)

(* One round with this [step], of [most] bids: whether every row has a column. *)
let auction ~spent ~most m dual step =
  let holder = Array.make m.columns (-1) and waiting = Queue.create () in
  let bids = ref 0 and lost = ref false in
  let bid row =
    incr bids;
    let cost, base = row_in m row in
    let least = ref max_int and second = ref max_int and choice = ref (-1) in
    for column = 0 to m.columns - 1 do
      let c = cost.(base + column) in
      if c < forbidden then begin
        let c = c - dual.(column) in
        if c < !second then
          if c < !least then begin
            second := !least;
            least := c;
            choice := column
          end
          else second := c
      end
    done;
    if !second = max_int then lost := true
    else begin
      dual.(!choice) <- dual.(!choice) - (!second - !least) - step;
      if holder.(!choice) >= 0 then Queue.add holder.(!choice) waiting;
      holder.(!choice) <- row
    end
  in
  for row = 0 to m.columns - 1 do
    Queue.add row waiting
  done;
  while (not (Queue.is_empty waiting)) && (not !lost) && !bids < most do
    bid (Queue.take waiting)
  done;
  spent := !spent + (!bids * m.columns);
  Queue.is_empty waiting && not !lost

let auctioned ~spent m =
  let dual = Array.make m.columns 0 in
  let dearest = Costs.dearest m.costs in
  let rec rounds step =
    if not (auction ~spent ~most:(50 * m.columns) m dual step) then None
    else if step = 1 then Some dual
    else rounds (max 1 (step / 5))
  in
  rounds (max 1 (dearest / 4))

(* Fewer rows are matched as fast without an auction; many more columns than rows make it slow. *)
let is_for_auction ~rows ~columns = rows >= 100 && rows <= columns && columns <= rows + (rows / 4)

(* {1 Searches} *)

(* Shortest augmenting paths, after Jonker and Volgenant (1987).

   One search runs Dijkstra's algorithm over the columns. [order] holds first the columns that are done, up to
   [low], then those at distance [least] that are not, up to [high], then the others. *)
let search_all ~spent m ~rows dual =
  let columns = m.columns in
  let column_of = Array.make rows (-1) and row_of = Array.make columns (-1) in
  take_cheapest m ~rows dual column_of row_of;
  spent := !spent + (rows * columns);
  let distance = Array.make columns 0 and previous = Array.make columns 0 in
  let order = Array.init columns Fun.id in
  let swap a b =
    let column = order.(a) in
    order.(a) <- order.(b);
    order.(b) <- column
  in
  let search start =
    let cost, base = row_in m start in
    for column = 0 to columns - 1 do
      let c = cost.(base + column) in
      distance.(column) <- (if c < forbidden then c - dual.(column) else max_int);
      previous.(column) <- start
    done;
    let low = ref 0 and high = ref 0 and least = ref 0 in
    let settled = ref 0 (* the columns that were done before [least] rose *) in
    let target = ref (-1) and stuck = ref (columns = 0) in
    while !target < 0 && not !stuck do
      if !low = !high then begin
        settled := !low;
        least := max_int;
        for place = !low to columns - 1 do
          let d = distance.(order.(place)) in
          if d < !least then begin
            high := !low;
            least := d
          end;
          if d = !least && d < max_int then begin
            swap place !high;
            incr high
          end
        done;
        spent := !spent + (columns - !low);
        if !low = !high then stuck := true
        else
          for place = !low to !high - 1 do
            if !target < 0 && row_of.(order.(place)) < 0 then target := order.(place)
          done
      end;
      if !target < 0 && not !stuck then begin
        let column = order.(!low) in
        incr low;
        let row = row_of.(column) in
        let cost, base = row_in m row in
        let saved = cost.(base + column) - dual.(column) - !least in
        let place = ref !high in
        spent := !spent + (columns - !high);
        while !target < 0 && !place < columns do
          let column = order.(!place) in
          let c = cost.(base + column) in
          if c < forbidden then begin
            let d = c - dual.(column) - saved in
            if d < distance.(column) then begin
              distance.(column) <- d;
              previous.(column) <- row;
              if d = !least then
                if row_of.(column) < 0 then target := column
                else begin
                  swap !place !high;
                  incr high
                end
            end
          end;
          incr place
        done
      end
    done;
    if !stuck then begin
      let scanned = List.init !low (fun place -> row_of.(order.(place))) in
      Error (List.sort Int.compare (start :: scanned))
    end
    else begin
      for place = 0 to !settled - 1 do
        let column = order.(place) in
        dual.(column) <- dual.(column) + distance.(column) - !least
      done;
      let rec augment column =
        let row = previous.(column) in
        let released = column_of.(row) in
        row_of.(column) <- row;
        column_of.(row) <- column;
        if row <> start then augment released
      in
      augment !target;
      Ok ()
    end
  in
  let rec from row =
    if row = rows then Ok { column_of; row_of; dual }
    else if column_of.(row) >= 0 then from (row + 1)
    else match search row with Ok () -> from (row + 1) | Error _ as error -> error
  in
  from 0

(* Without the rows that cost nothing. These hold columns of the greatest dual, which becomes 0. *)
let given_rows ~rows { column_of; row_of; dual } =
  let greatest = Array.fold_left max min_int dual in
  { column_of = Array.sub column_of 0 rows;
    row_of = Array.map (fun row -> if row < rows then row else -1) row_of;
    dual = Array.map (fun d -> d - greatest) dual }

let solve ~spent ({ rows; columns; _ } as costs : Costs.t) =
  let m = square costs in
  match if is_for_auction ~rows ~columns then auctioned ~spent m else None with
  | Some dual -> Result.map (given_rows ~rows) (search_all ~spent m ~rows:columns dual)
  | None -> search_all ~spent m ~rows (Array.make columns 0)

(* The matchings that cost as little as the one given are those of all rows that use tight pairs only, of reduced
   cost 0, and every column whose dual is below 0. To see them as perfect matchings, one more row, [spare], holds all
   columns that are free, and may hold any whose dual is 0. Row by row, a lower column is taken if, along tight
   pairs between later rows, its holder can in the end be given the column that the row gave up. *)
let in_pick_order ({ rows; columns; _ } as costs : Costs.t) { column_of; row_of; dual } =
  let spare = rows in
  let column_of = Array.copy column_of in
  let holder = Array.map (fun row -> if row < 0 then spare else row) row_of in
  let tight = Array.init (rows + 1) (fun _ -> Bits.make columns) in
  let buffer = Array.make columns 0 in
  for row = 0 to rows - 1 do
    let cost, base = Costs.row costs row buffer in
    let own = column_of.(row) in
    let least = cost.(base + own) - dual.(own) in
    for column = 0 to columns - 1 do
      let c = cost.(base + column) in
      if c < forbidden && c - dual.(column) = least then Bits.add tight.(row) column
    done
  done;
  Array.iteri (fun column d -> if d = 0 then Bits.add tight.(spare) column) dual;
  let visited = Array.make (rows + 1) (-1) (* for the sake of which row, last *) in
  let gives_up = Array.make (rows + 1) 0 and gives_to = Array.make (rows + 1) 0 in
  let queue = Queue.create () in
  let visit row ~taker column =
    let next = holder.(column) in
    if next > row && visited.(next) <> row then begin
      visited.(next) <- row;
      gives_up.(next) <- column;
      gives_to.(next) <- taker;
      Queue.add next queue
    end
  in
  (* The rows that can take the column [wanted], among those that can be reached by giving up columns; breadth first. *)
  let rec last_taker row wanted =
    match Queue.take_opt queue with
    | None -> None
    | Some taker when Bits.mem tight.(taker) wanted -> Some taker
    | Some taker ->
      Bits.iter (visit row ~taker) tight.(taker);
      last_taker row wanted
  in
  let rec hand_over row taker column =
    holder.(column) <- taker;
    if taker <> spare then column_of.(taker) <- column;
    if taker <> row then hand_over row gives_to.(taker) gives_up.(taker)
  in
  for row = 0 to rows - 1 do
    let wanted = column_of.(row) in
    let rec lower column =
      match Bits.next tight.(row) column with
      | Some column when column < wanted -> (
          Queue.clear queue;
          visit row ~taker:row column;
          match last_taker row wanted with
          | Some taker -> hand_over row taker wanted
          | None -> lower (column + 1))
      | Some _ | None -> ()
    in
    lower 0
  done;
  column_of
