import{h as e}from"./chunk-GYUW27G2.js";function i(){return e("h1",{children:"StudiesView"})}export{i as StudiesView};
